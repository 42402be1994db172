// SPDX-License-Identifier: Apache-2.0
import type uPlot from 'uplot';
import {kCourse_s, type CoursePoint} from '../../model/readings';
import type {Palette} from '../../panel_api';
import {kFont} from '../world/labels';
import {roundStep, tickText} from '../world/ticks';
import type {CourseField} from './course_fields';
import {gapsOf, type Gap} from './course_gaps';

/** One line of a plot over time. */
export interface CourseLine {
  points: readonly CoursePoint[];
  colour: string;
  dashed?: boolean;
  /** Each value is a dot, as values may stand alone between gaps. */
  dots?: boolean;
}

const kFont_px = 10;
/** A text of an axis needs so much. */
const kTicks_px = 22;
const kNoReadings = 'no readings';
/** Between two lines of a hatch. */
const kHatch_px = 7;

/** The moment that a plot ends at. */
export interface CourseMoment {
  now_s: number;
  /** When the run, or its recording, began. */
  begin_s: number;
  /** Of the sensor; 0 where it is not known. */
  period_s: number;
}

/** One field of a sensor over the last seconds, with the value under the pointer. uPlot is loaded
 * with the first one. */
export class CoursePlot {
  private plot: uPlot | null = null;
  private library: typeof uPlot | null = null;
  private asked = false;
  private look = '';
  /** Under the pointer: a value of each line and how long ago; null: the pointer is elsewhere. */
  pointed: {values: (number | null)[]; ago_s: number} | null = null;
  /** Where the first line has no readings. */
  gaps: readonly Gap[] = [];

  /** `changed` is called when the pointer is at another value, and once the plot can be drawn. */
  constructor(private readonly changed: () => void) {}

  /** Draws in `host`, which it fills. */
  draw(
    host: HTMLElement,
    lines: readonly CourseLine[],
    field: CourseField,
    moment: CourseMoment,
    palette: Palette,
  ): void {
    const {clientWidth: width, clientHeight: height} = host;
    if (width === 0 || height === 0 || !this.ready()) return;
    const {now_s, begin_s, period_s} = moment;
    this.gaps = gapsOf(
      shownOf(lines[0], now_s).map((point) => point.time_s - now_s),
      Math.max(-kCourse_s, begin_s - now_s),
      period_s,
    );
    const look = [
      palette.theme,
      field.label,
      field.unit,
      ...lines.map(({colour, dashed}) => `${colour} ${dashed ?? false}`),
    ].join();
    if (this.plot === null || look !== this.look || this.plot.root.parentElement !== host)
      this.make(host, width, height, lines, field, palette);
    this.look = look;
    const {plot} = this;
    if (plot === null) return;
    if (plot.width !== width || plot.height !== height) plot.setSize({width, height});
    plot.setData(this.table(lines, field, now_s));
  }

  dispose(): void {
    this.plot?.destroy();
    this.plot = null;
    this.pointed = null;
  }

  private ready(): boolean {
    if (this.library === null && !this.asked) {
      this.asked = true;
      void import('uplot').then((module) => {
        this.library = module.default;
        this.changed();
      });
    }
    return this.library !== null;
  }

  /** Times are counted from now, so that the axis stands still. */
  private table(
    lines: readonly CourseLine[],
    field: CourseField,
    now_s: number,
  ): uPlot.AlignedData {
    const tables = lines.map((line): uPlot.AlignedData => {
      const values = shownOf(line, now_s).map((point): [number, number | null] => [
        point.time_s - now_s,
        finite(field.of(point)),
      ]);
      // null is a gap.
      for (const [from, to] of this.gaps) {
        const next = values.findIndex(([t]) => t >= to - 1e-6);
        if (next > 0) values.splice(next, 0, [(from + to) / 2, null]);
      }
      return [values.map(([t]) => t), values.map(([, value]) => value)];
    });
    if (tables.every(([times]) => times.length === 0))
      return [[], ...lines.map(() => [])] as unknown as uPlot.AlignedData;
    return tables.length === 1
      ? tables[0]
      : (this.library as typeof uPlot).join(
          tables,
          tables.map(() => [2, 2]),
        );
  }

  private make(
    host: HTMLElement,
    width: number,
    height: number,
    lines: readonly CourseLine[],
    field: CourseField,
    palette: Palette,
  ): void {
    this.dispose();
    const Plot = this.library as typeof uPlot;
    this.plot = new Plot(
      {
        width,
        height,
        padding: [8, 16, 0, 0],
        legend: {show: false},
        cursor: {y: false, drag: {x: false, y: false}, points: {size: 6}},
        scales: {
          x: {time: false, range: [-kCourse_s, 0]},
          y: {range: (_, low, high) => spanOf(low, high)},
        },
        axes: axesOf(palette, height, field),
        series: [
          {},
          ...lines.map(
            ({colour, dashed, dots}): uPlot.Series => ({
              stroke: colour,
              width: 1.5,
              points: {show: dots === true ? true : alone, size: 4, width: 0, fill: colour},
              spanGaps: false,
              ...(dashed === true ? {dash: [4, 3]} : {}),
            }),
          ),
        ],
        hooks: {
          setCursor: [(plot) => this.point(plot)],
          drawAxes: [(plot) => this.hatch(plot, palette)],
        },
      },
      this.table(lines, field, 0),
      host,
    );
  }

  /** Where there are no readings. */
  private hatch(plot: uPlot, palette: Palette): void {
    const {ctx, bbox} = plot;
    const scale = devicePixelRatio;
    ctx.save();
    ctx.font = `400 ${kFont_px * scale}px ${kFont}`;
    for (const [from, to] of this.gaps) {
      const [left, right] = [from, to].map((t) => plot.valToPos(t, 'x', true));
      ctx.save();
      ctx.beginPath();
      ctx.rect(left, bbox.top, right - left, bbox.height);
      ctx.clip();
      ctx.strokeStyle = palette.token('line-2');
      ctx.lineWidth = scale;
      ctx.beginPath();
      for (let x = left - bbox.height; x < right; x += kHatch_px * scale) {
        ctx.moveTo(x, bbox.top + bbox.height);
        ctx.lineTo(x + bbox.height, bbox.top);
      }
      ctx.stroke();
      this.labelHatch(ctx, (left + right) / 2, bbox.top + bbox.height / 2, right - left, palette);
      ctx.restore();
    }
    ctx.restore();
  }

  private labelHatch(
    ctx: CanvasRenderingContext2D,
    x: number,
    y: number,
    room: number,
    palette: Palette,
  ): void {
    const scale = devicePixelRatio;
    const width = ctx.measureText(kNoReadings).width + 12 * scale;
    if (width > room) return;
    ctx.fillStyle = palette.token('bg-1');
    ctx.fillRect(x - width / 2, y - 8 * scale, width, 16 * scale);
    ctx.fillStyle = palette.token('text-3');
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    ctx.fillText(kNoReadings, x, y);
  }

  private point(plot: uPlot): void {
    const {idx} = plot.cursor;
    const before = this.pointed;
    this.pointed =
      idx === null || idx === undefined
        ? null
        : {values: plot.data.slice(1).map((line) => line[idx] ?? null), ago_s: -plot.data[0][idx]};
    if (before !== null || this.pointed !== null) this.changed();
  }
}

/** The readings of a line that the plot shows. */
function shownOf({points}: CourseLine, now_s: number): CoursePoint[] {
  return points.filter(({time_s}) => time_s >= now_s - kCourse_s && time_s <= now_s + 1e-3);
}

/** A line of a single value would not be seen. */
function alone(plot: uPlot, series: number): boolean {
  return plot.data[series].length === 1;
}

function finite(value: number): number | null {
  return Number.isFinite(value) ? value : null;
}

/** From zero, or from the lowest below it, to a round number. */
export function spanOf(low: number | null, high: number | null): [number, number] {
  const bottom = Math.min(low ?? 0, 0);
  const top = Math.max(high ?? 0, bottom < 0 ? 0 : 0.1);
  const step = roundStep((top - bottom) / 2.5);
  // No minus before a zero.
  return [Math.floor(bottom / step + 1e-9) * step + 0, Math.ceil(top / step - 1e-9) * step + 0];
}

/** Round numbers with room for their texts. */
export function ticksOf(low: number, high: number, height: number): number[] {
  const most = Math.max(Math.floor((height - 26) / kTicks_px), 2);
  const step = roundStep(Math.max((high - low) / most, 1e-6));
  const ticks: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9; ++k) ticks.push(k * step + 0);
  return ticks;
}

/** Seconds below, values at the left with their unit at the top one. */
function axesOf(palette: Palette, height: number, field: CourseField): uPlot.Axis[] {
  const faint = palette.token('text-3');
  const axis = {
    stroke: faint,
    font: `400 ${kFont_px}px ${kFont}`,
    grid: {stroke: palette.token('line-1'), width: 1},
    ticks: {show: false},
  };
  return [
    {
      ...axis,
      size: 18,
      gap: 3,
      splits: () => [-10, -5, 0],
      values: (_, at) => at.map((t) => (t === 0 ? 'now' : `−${-t} s`)),
    },
    {
      ...axis,
      size: 40,
      gap: 4,
      splits: (_, __, low, high) => ticksOf(low, high, height),
      values: (_, at) =>
        at.map(
          (value, i) =>
            tickText(value, at.length > 1 ? at[1] - at[0] : 1) +
            (i === at.length - 1 && field.unit !== '' ? ` ${field.unit}` : ''),
        ),
    },
  ];
}
