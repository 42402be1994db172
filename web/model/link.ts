// SPDX-License-Identifier: Apache-2.0
import type {Look, PageMessage, ProbeRequest, ServerMessage} from '../protocol/messages';
import type {DirectLines} from './direct_lines';
import {LineStops} from './line_stops';
import {OrderRouter} from './order_router';
import {PictureAge} from './picture_age';
import type {RunModel} from './run_model';
import type {MapKey} from './maps';
import {Windows} from './windows';
import {Signal} from './signal';
import {SilenceWatch} from './silence';

const kFirstRetry_ms = 500;
const kLongestRetry_ms = 8000;
const kProbeRest_ms = 120;
/** The server sends the time once a second at least, whatever the run does and whatever this person
 * may see. */
const kSilent_ms = 3000;
/** The first messages of a run may be large and the line slow. */
const kPatience_ms = 15_000;

/** `refused`: the user has no access. `empty`: the server has no run. */
export type LinkState = 'opening' | 'open' | 'lost' | 'refused' | 'empty';

const kNotSignedIn = 4401;
const kNotAllowed = 4403;
const kNoRun = 4404;
/** The server takes no more sensors, and no more robots, in one message. */
const kMostLooked = 256;

/** The sensors whose readings something shows: slot of the robot and index of the sensor. */
export type Interest = readonly [number, number][];

/** The WebSocket to the GUI Server. It reconnects by itself, and tells the server what the page
 * looks at. */
export class Link {
  state: LinkState = 'opening';
  /** performance.now() when the link was lost, and when it is tried again. */
  lostAt_ms = 0;
  retryAt_ms = 0;
  /** Why the server did not let us in. */
  refusal = '';
  /** Measured at the page: frames per second, and bytes per second. */
  rate_hz = 0;
  readonly age: PictureAge;
  bytesPerSecond = 0;
  readonly changed = new Signal();

  private readonly router: OrderRouter | null;
  /** Who stands while the server is away; null: there are no direct lines. */
  readonly stops: LineStops | null;
  private socket: WebSocket | null = null;
  private retry_ms = kFirstRetry_ms;
  private timer = 0;
  /** For how long the line may be silent. */
  private limit_ms = kPatience_ms;
  private readonly silence: SilenceWatch = new SilenceWatch(() =>
    this.lose('lost', this.silence.heardAt_ms),
  );
  private readonly interests = new Map<object, Interest>();
  private lastLook = '';
  private lookQueued = false;
  private readonly mapInterests = new Map<object, MapKey>();
  private lastMaps = '[]';
  private toldKey = '';
  private frames = 0;
  private bytes = 0;
  private probeTimer = 0;
  private probesSaid = false;
  /** Whether a panel shows which virtual sensors exist. */
  wantsCatalogue = false;
  private truePoses = false;
  private variances: readonly number[] = [];
  parts = false;
  /** Sensors whose readings before the moment of a replay are drawn, too. */
  courses: Interest = [];

  constructor(
    private readonly model: RunModel,
    private readonly url: string,
    /** The direct lines; null: all goes through the server. */
    readonly direct: DirectLines | null = null,
    private readonly windows = new Windows(),
  ) {
    this.age = new PictureAge(/^(127\..*|localhost|\[?::1\]?)$/.test(new URL(url).hostname));
    this.router = direct === null ? null : new OrderRouter(model, direct);
    if (this.router) this.router.serverIsThere = () => this.state === 'open';
    this.stops = direct === null ? null : new LineStops(model, direct);
    direct?.changed.on(() => {
      this.tellPage();
      if (this.state === 'lost') this.stops?.take();
    });
    setInterval(() => this.measure(), 1000);
    // The server has forgotten what is looked at: robots and maps may be others now.
    model.runChanged.on(() => {
      this.lastLook = '';
      this.lastMaps = '[]';
      this.queueLook();
      this.askCatalogue();
      this.tryProbes();
    });
    model.maps.namesChanged.on(() => this.lookAtMaps());
    model.maps.overlayChanged.on(() => this.lookAtMap(model.maps, model.maps.overlay?.key ?? null));
  }

  open(): void {
    clearTimeout(this.timer);
    this.drop();
    const socket = new WebSocket(this.url, 'rave.gui.1');
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    this.silence.heard(kPatience_ms);
    socket.onopen = () => {
      // Without a run the server has nothing to say.
      this.silence.end();
      this.lastLook = '';
      this.lastMaps = '[]';
      this.toldKey = '';
      this.tellPage();
      this.queueLook();
    };
    socket.onmessage = (message: MessageEvent<string | ArrayBuffer>) =>
      this.take(socket, message.data);
    socket.onclose = (event) => {
      if (this.socket !== socket) return;
      if (event.code === kNotSignedIn || event.code === kNotAllowed) {
        this.drop();
        this.refusal = event.reason;
        this.set('refused');
        return;
      }
      this.lose(event.code === kNoRun ? 'empty' : 'lost');
    };
  }

  /** Whether orders can reach robots, over the server or a direct line. */
  get reaches(): boolean {
    return this.state === 'open' || (this.direct?.open.length ?? 0) > 0;
  }

  /** Whether orders can reach this robot. */
  reachesRobot(slot: number): boolean {
    return (
      this.state === 'open' ||
      this.direct?.lineOf(this.model.robots[slot]?.name ?? '')?.state === 'open'
    );
  }

  send(message: PageMessage): void {
    const rest = this.router === null ? message : this.router.route(message);
    if (rest !== null) this.sendToServer(rest);
  }

  /** What goes through the server is of the same page as what goes over direct lines. */
  private tellPage(): void {
    const key = this.direct?.point ?? '';
    if (key === '' || key === this.toldKey || this.socket?.readyState !== WebSocket.OPEN) return;
    this.toldKey = key;
    this.sendToServer({type: 'page', key});
  }

  private sendToServer(message: PageMessage): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  /** `owner` shows the readings of these sensors from now on, and no others; an empty list ends
   * that. Without an owner that looks at a sensor the server does not send its readings. */
  look(owner: object, sensors: Interest): void {
    if (sensors.length === 0) this.interests.delete(owner);
    else this.interests.set(owner, sensors);
    this.queueLook();
  }

  /** The robots whose variances of reported poses are shown. */
  lookAtVariances(slots: readonly number[]): void {
    this.variances = slots;
    this.queueLook();
  }

  /** Whether true poses are shown; the server sends them to those who may have them. */
  lookAtTruth(wanted: boolean): void {
    if (wanted === this.truePoses) return;
    this.truePoses = wanted;
    this.queueLook();
  }

  /** `owner` shows this map; null ends that. */
  lookAtMap(owner: object, key: MapKey | null): void {
    if (key === null) this.mapInterests.delete(owner);
    else this.mapInterests.set(owner, key);
    this.lookAtMaps();
  }

  /** `owner` tries this virtual sensor; null ends that. */
  tryProbe(owner: object, request: ProbeRequest | null): void {
    if (this.model.probes.ask(owner, request)) this.tryProbes();
  }

  /** A slider sends many values while it is pulled; the last one counts. */
  private tryProbes(): void {
    clearTimeout(this.probeTimer);
    this.probeTimer = window.setTimeout(() => {
      const all = this.model.probes.next();
      if (all.probes.length > 0 || this.probesSaid)
        this.sendToServer({type: 'look_probes', ...all});
      this.probesSaid = all.probes.length > 0;
    }, kProbeRest_ms);
  }

  /** Asks once in a run which virtual sensors there are, if this person may try any. */
  askCatalogue(): void {
    if (!this.wantsCatalogue || this.model.probes.drivers !== null || !this.model.may('probe'))
      return;
    this.sendToServer({type: 'ask_catalogue', request: 0});
  }

  private lookAtMaps(): void {
    const {maps} = this.model;
    const known = new Set<MapKey>(maps.names.map((name) => name.slot ?? name.name));
    const keys = [...new Set(this.mapInterests.values())]
      .filter((key) => known.has(key))
      .slice(0, 4);
    const text = JSON.stringify(keys);
    if (text === this.lastMaps || this.socket?.readyState !== WebSocket.OPEN) return;
    this.lastMaps = text;
    maps.keep(keys);
    this.sendToServer({type: 'look_maps', maps: keys});
  }

  /** Says again what the page looks at, if it changed. */
  queueLook(): void {
    if (this.lookQueued) return;
    this.lookQueued = true;
    queueMicrotask(() => {
      this.lookQueued = false;
      const all = new Map<string, [number, number]>();
      for (const interest of this.interests.values()) {
        for (const pair of interest) all.set(pair.join(), [pair[0], pair[1]]);
      }
      const seen = this.windows.visible !== undefined;
      const look: Look = {
        type: 'look',
        poses: seen,
        true_poses: this.truePoses,
        readings: seen ? [...all.values()].slice(0, kMostLooked) : [],
        courses: seen ? this.courses.map(([slot, sensor]) => [slot, sensor]) : [],
        variances: seen ? this.variances.slice(-kMostLooked) : [],
        parts: this.parts,
        max_hz: 30,
      };
      const text = JSON.stringify(look);
      if (text === this.lastLook || this.socket?.readyState !== WebSocket.OPEN) return;
      this.lastLook = text;
      this.socket.send(text);
    });
  }

  private take(socket: WebSocket, data: string | ArrayBuffer): void {
    if (this.socket !== socket) return;
    if (typeof data === 'string') {
      const message = JSON.parse(data) as ServerMessage;
      if (message.type === 'hello') this.limit_ms = kPatience_ms;
      else if (message.type === 'time') this.limit_ms = kSilent_ms;
      this.silence.heard(this.limit_ms);
      this.model.takeMessage(message);
      // Only now is it known that the server has something to say.
      if (this.state !== 'open') {
        this.retry_ms = kFirstRetry_ms;
        this.set('open');
      }
      return;
    }
    this.silence.heard(this.limit_ms);
    this.bytes += data.byteLength;
    this.age.take(data, performance.timeOrigin + performance.now());
    const sequence = this.model.takeFrame(data, performance.now());
    // Once it can be drawn: a page that cannot keep up is sent less.
    if (sequence !== null) {
      ++this.frames;
      const acknowledge = () => this.sendToServer({type: 'ack', sequence});
      const view = this.windows.visible;
      if (view === undefined) acknowledge();
      else view.requestAnimationFrame(acknowledge);
    }
  }

  /** What this socket still brings does not count any more. */
  private drop(): void {
    const old = this.socket;
    this.socket = null;
    this.silence.end();
    old?.close();
  }

  private lose(state: 'lost' | 'empty', at_ms = performance.now()): void {
    if (this.state !== 'lost') this.lostAt_ms = at_ms;
    this.drop();
    this.retryAt_ms = performance.now() + this.retry_ms;
    this.timer = window.setTimeout(() => this.open(), this.retry_ms);
    this.retry_ms = Math.min(2 * this.retry_ms, kLongestRetry_ms);
    // A server that keeps telling that it has no run is reached again and again without a flicker.
    this.set(state);
  }

  private set(state: LinkState): void {
    this.state = state;
    if (state === 'lost') this.stops?.take();
    this.changed.emit();
  }

  private measure(): void {
    this.rate_hz = this.frames;
    this.bytesPerSecond = this.bytes;
    this.frames = 0;
    this.bytes = 0;
    this.changed.emit();
  }
}
