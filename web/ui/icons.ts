// SPDX-License-Identifier: Apache-2.0
// Lucide icons (ISC), as the text of their SVG.
import {html, type TemplateResult} from 'lit';
import {unsafeHTML} from 'lit/directives/unsafe-html.js';
import activity from 'lucide-static/icons/activity.svg?raw';
import bell from 'lucide-static/icons/bell.svg?raw';
import bot from 'lucide-static/icons/bot.svg?raw';
import camera from 'lucide-static/icons/camera.svg?raw';
import check from 'lucide-static/icons/check.svg?raw';
import chevronDown from 'lucide-static/icons/chevron-down.svg?raw';
import circleX from 'lucide-static/icons/circle-x.svg?raw';
import compass from 'lucide-static/icons/compass.svg?raw';
import copy from 'lucide-static/icons/copy.svg?raw';
import crosshair from 'lucide-static/icons/locate.svg?raw';
import download from 'lucide-static/icons/download.svg?raw';
import ellipsis from 'lucide-static/icons/ellipsis.svg?raw';
import eye from 'lucide-static/icons/eye.svg?raw';
import fileText from 'lucide-static/icons/file-text.svg?raw';
import filter from 'lucide-static/icons/funnel.svg?raw';
import flask from 'lucide-static/icons/flask-conical.svg?raw';
import hourglass from 'lucide-static/icons/hourglass.svg?raw';
import info from 'lucide-static/icons/info.svg?raw';
import layers from 'lucide-static/icons/layers.svg?raw';
import link from 'lucide-static/icons/link.svg?raw';
import list from 'lucide-static/icons/list.svg?raw';
import lock from 'lucide-static/icons/lock.svg?raw';
import map from 'lucide-static/icons/map.svg?raw';
import maximize from 'lucide-static/icons/maximize.svg?raw';
import maximize2 from 'lucide-static/icons/maximize-2.svg?raw';
import minimize2 from 'lucide-static/icons/minimize-2.svg?raw';
import minus from 'lucide-static/icons/minus.svg?raw';
import moon from 'lucide-static/icons/moon.svg?raw';
import octagonX from 'lucide-static/icons/octagon-x.svg?raw';
import pause from 'lucide-static/icons/pause.svg?raw';
import pin from 'lucide-static/icons/pin.svg?raw';
import play from 'lucide-static/icons/play.svg?raw';
import plus from 'lucide-static/icons/plus.svg?raw';
import radar from 'lucide-static/icons/radar.svg?raw';
import refresh from 'lucide-static/icons/refresh-cw.svg?raw';
import rotateCcw from 'lucide-static/icons/rotate-ccw.svg?raw';
import ruler from 'lucide-static/icons/ruler.svg?raw';
import search from 'lucide-static/icons/search.svg?raw';
import server from 'lucide-static/icons/server.svg?raw';
import shield from 'lucide-static/icons/shield.svg?raw';
import skipBack from 'lucide-static/icons/skip-back.svg?raw';
import skipForward from 'lucide-static/icons/skip-forward.svg?raw';
import stepBack from 'lucide-static/icons/step-back.svg?raw';
import stepForward from 'lucide-static/icons/step-forward.svg?raw';
import sun from 'lucide-static/icons/sun.svg?raw';
import target from 'lucide-static/icons/target.svg?raw';
import triangleAlert from 'lucide-static/icons/triangle-alert.svg?raw';
import wifiOff from 'lucide-static/icons/wifi-off.svg?raw';
import boxSelect from 'lucide-static/icons/pentagon.svg?raw';
import cornerDownLeft from 'lucide-static/icons/corner-down-left.svg?raw';
import gamepad from 'lucide-static/icons/gamepad-2.svg?raw';
import hand from 'lucide-static/icons/hand.svg?raw';
import joystick from 'lucide-static/icons/joystick.svg?raw';
import keyRound from 'lucide-static/icons/key-round.svg?raw';
import keyboard from 'lucide-static/icons/keyboard.svg?raw';
import message from 'lucide-static/icons/message-square.svg?raw';
import packageX from 'lucide-static/icons/package-x.svg?raw';
import pointer from 'lucide-static/icons/mouse-pointer-2.svg?raw';
import move from 'lucide-static/icons/move.svg?raw';
import send from 'lucide-static/icons/send.svg?raw';
import route from 'lucide-static/icons/route.svg?raw';
import trash from 'lucide-static/icons/trash-2.svg?raw';
import userPlus from 'lucide-static/icons/user-plus.svg?raw';
import x from 'lucide-static/icons/x.svg?raw';
import zap from 'lucide-static/icons/zap.svg?raw';
import appWindow from 'lucide-static/icons/app-window.svg?raw';
import share from 'lucide-static/icons/share-2.svg?raw';
import undo from 'lucide-static/icons/undo-2.svg?raw';

const kIcons = {
  activity,
  bell,
  bot,
  camera,
  check,
  chevronDown,
  circleX,
  compass,
  crosshair,
  download,
  eye,
  fileText,
  filter,
  flask,
  hourglass,
  info,
  layers,
  link,
  list,
  lock,
  map,
  maximize,
  maximize2,
  minimize2,
  minus,
  moon,
  octagonX,
  pause,
  pin,
  play,
  plus,
  radar,
  refresh,
  rotateCcw,
  ruler,
  search,
  server,
  shield,
  skipBack,
  skipForward,
  stepBack,
  stepForward,
  sun,
  target,
  triangleAlert,
  wifiOff,
  send,
  x,
  zap,
  boxSelect,
  cornerDownLeft,
  gamepad,
  hand,
  joystick,
  keyboard,
  message,
  packageX,
  pointer,
  move,
  route,
  trash,
  copy,
  ellipsis,
  keyRound,
  userPlus,
  appWindow,
  share,
  undo,
};

export type IconName = keyof typeof kIcons;

/** An icon of 16 px in the colour of the text; names and tooltips are given by what it stands
 * in. */
export function icon(name: IconName, size = 16): TemplateResult {
  const svg = kIcons[name]
    .replace(/<!--.*?-->/gs, '')
    .replace(/class="[^"]*"/, '')
    .replace(/\bwidth="24"/, `width="${size}"`)
    .replace(/\bheight="24"/, `height="${size}"`)
    .replace(/stroke-width="2"/, 'stroke-width="1.75" aria-hidden="true"');
  return html`${unsafeHTML(svg)}`;
}
