// SPDX-License-Identifier: Apache-2.0
import type {Palette} from '../../panel_api';
import type {Placed} from '../../model/pose_history';
import {RobotFlag} from '../../protocol/frames';
import type {Robot} from '../../protocol/messages';
import type {Camera} from './camera';
import {kFont, type LabelPlacer} from './labels';

const kLeastMembers = 20;
const kShifts_px = [0, -32, 32, -64, 64, -96, 96];

export interface Team {
  name: string;
  count: number;
  x: number;
  y: number;
  speed: number;
}

/** The middle of each large team that can be seen, with its number and mean speed. */
export function teamsOf(
  robots: readonly Robot[],
  placed: Placed,
  speeds: Float32Array | undefined,
): Team[] {
  const teams = new Map<string, Team>();
  for (let slot = 0; slot < placed.count; ++slot) {
    if ((placed.flags[slot] & RobotFlag.known) === 0) continue;
    const {team} = robots[slot];
    let sum = teams.get(team);
    if (sum === undefined) teams.set(team, (sum = {name: team, count: 0, x: 0, y: 0, speed: 0}));
    ++sum.count;
    sum.x += placed.x[slot];
    sum.y += placed.y[slot];
    sum.speed += Math.abs(speeds?.[slot] ?? 0);
  }
  return [...teams.values()]
    .filter((team) => team.name !== '' && team.count >= kLeastMembers)
    .map((team) => ({
      ...team,
      x: team.x / team.count,
      y: team.y / team.count,
      speed: team.speed / team.count,
    }));
}

/** Plates over the crowd: name, number, mean speed. */
export function drawPlates(
  ctx: CanvasRenderingContext2D,
  camera: Camera,
  teams: readonly Team[],
  palette: Palette,
  placer: LabelPlacer,
): void {
  ctx.textBaseline = 'middle';
  ctx.textAlign = 'left';
  for (const team of teams) {
    const rest = `${team.count} · ${team.speed.toFixed(2)} m/s`;
    ctx.font = `600 12px ${kFont}`;
    const nameWidth = ctx.measureText(team.name).width;
    ctx.font = `400 11px ${kFont}`;
    const width = nameWidth + 8 + ctx.measureText(rest).width + 24;
    const x = camera.toScreenX(team.x) - width / 2;
    const middle = camera.toScreenY(team.y);
    // A plate gives way to robots that matter.
    const shift =
      kShifts_px.find((dy) => placer.isFree(x + width / 2, middle + dy, width / 2, 13)) ?? 0;
    const y = middle + shift;
    if (x + width < 0 || x > camera.width || y < 0 || y > camera.height) continue;
    ctx.globalAlpha = 0.88;
    ctx.fillStyle = palette.token('bg-1');
    ctx.beginPath();
    ctx.roundRect(x, y - 13, width, 26, 13);
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.fillStyle = palette.token('text-2');
    ctx.fillText(rest, x + 20 + nameWidth, y + 0.5);
    ctx.font = `600 12px ${kFont}`;
    ctx.fillStyle = palette.token('text-1');
    ctx.fillText(team.name, x + 12, y + 0.5);
    placer.block(x + width / 2, y, width / 2, 13);
  }
}
