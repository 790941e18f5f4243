// Charts with a cursor that reads values, by mouse, finger or arrow keys. Curves that turn back come as several lines.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { h } from "./dom";
import { digits, pretty, scaled } from "./units";

export interface Line {
  law: string;
  /** What it is, if that of its chart is not enough. */
  what?: string;
  /** Colour, by the law's place in the list. */
  colour: number;
  x: number[];
  y: number[];
  thin?: boolean;
  dashed?: boolean;
  right?: boolean;
}

/** What is around a line because a strength is uncertain. */
export interface Band {
  line: Line;
  x: number[];
  low: number[];
  high: number[];
}

export interface Axes {
  title: string;
  test: string;
  x: { label: string; unit: string; logarithmic?: boolean };
  y: { label: string; unit: string };
  right?: { label: string; unit: string };
  dashed: string;
}

const css = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const scheme = matchMedia("(prefers-color-scheme: dark)");

/** The value of a line at x, null beyond its ends; x of the line increase. */
export function valueAt({ x, y }: Pick<Line, "x" | "y">, at: number): number | null {
  let low = 0;
  let high = x.length - 1;
  if (high < 0 || at < x[0]! || at > x[high]!) return null;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle]! <= at) low = middle;
    else high = middle;
  }
  const width = x[high]! - x[low]!;
  return width > 0 ? y[low]! + ((y[high]! - y[low]!) * (at - x[low]!)) / width : y[high]!;
}

/** Points of x at which all lines are drawn: evenly spaced, and the ends of each. */
function grid(lines: Pick<Line, "x">[]): number[] {
  const ends = lines.flatMap(({ x }) => [x[0], x.at(-1)]).filter((end) => end !== undefined);
  const longest = lines.reduce<number[]>((best, { x }) => (x.length > best.length ? x : best), []);
  const [first, last] = [Math.min(...ends), Math.max(...ends)];
  const even = Array.from({ length: 301 }, (_, index) => first + ((last - first) * index) / 300);
  return [...new Set([...(longest.length < 100 ? longest : even), ...ends])].sort((a, b) => a - b);
}

const largest = (numbers: number[]): number => numbers.reduce((most, one) => Math.max(most, Math.abs(one)), 0);

export class Chart {
  readonly element: HTMLElement;
  readonly #plot: HTMLElement;
  readonly #readout: HTMLElement;
  #uplot: uPlot | null = null;
  #lines: Line[] = [];
  #bands: Band[] = [];
  #shape = "";
  #mark: number | undefined;

  constructor(readonly axes: Axes) {
    this.#plot = h("div", { class: "plot", tabindex: 0, role: "img", "aria-label": `${axes.title}: arrow keys read values`,
      "data-test": `${axes.test}.plot`, onkeydown: (event: KeyboardEvent) => this.#keys(event) });
    this.#readout = h("p", { class: "readout", "data-test": `${axes.test}.readout` });
    this.element = h("figure", { class: "chart", "data-test": axes.test }, h("figcaption", {}, axes.title), this.#plot, this.#readout);
    new ResizeObserver(() => this.#uplot?.setSize(this.#size())).observe(this.#plot);
    scheme.addEventListener("change", () => ((this.#shape = ""), this.draw(this.#lines, this.#bands)));
  }

  /** Draws lines, and bands around some of them; a logarithmic axis has a mark where the scene is. */
  draw(lines: Line[], bands: Band[] = [], mark = this.#mark): void {
    this.#lines = lines;
    this.#bands = bands;
    this.#mark = mark;
    const { x, y, right } = this.axes;
    const sides = [lines.filter((line) => !line.right), lines.filter((line) => line.right)] as const;
    const horizontal = x.logarithmic ? { factor: 1, unit: x.unit } : scaled(Math.max(...lines.map((line) => largest(line.x))), x.unit);
    const scales = sides.map((side, index) => scaled(Math.max(...side.map((line) => largest(line.y))), (index ? right?.unit : y.unit) ?? ""));
    const points = lines.length ? grid([...lines, ...bands]) : [];
    const edges = bands.flatMap(({ line, x, low, high }) => [low, high].map((y) => ({ ...line, x, y })));
    const data = [points.map((point) => point / horizontal.factor),
      ...[...lines, ...edges].map((line) => points.map((point) =>
        ((value) => value === null ? null : value / scales[line.right ? 1 : 0]!.factor)(valueAt(line, point))))] as uPlot.AlignedData;
    const shape = JSON.stringify([horizontal, scales, bands.length, lines.map(({ law, what, colour }) => [law, what, colour])]);
    if (shape === this.#shape && this.#uplot) {
      this.#uplot.setData(data);
      this.#read(this.#uplot.cursor.idx ?? null);
      return;
    }
    this.#shape = shape;
    this.#uplot?.destroy();
    const axis = (label: string, unit: string, side: number, grid: boolean, scale: string): uPlot.Axis => ({
      label: unit ? `${label} [${pretty(unit)}]` : label, side, scale, stroke: css("--muted"), font: "11px system-ui", labelFont: "11px system-ui", labelSize: 16, labelGap: 0,
      size: side === 2 ? 26 : 44, gap: 2, grid: { show: grid, stroke: css("--line"), width: 1 }, ticks: { show: false }, space: side === 2 ? 44 : 32,
      values: (_, splits) => splits.map((split) => (split === null ? "" : digits(split, 3))),
    });
    this.#uplot = new uPlot({
      ...this.#size(),
      padding: [8, right ? 4 : 12, 0, 0],
      legend: { show: false },
      cursor: { y: false, drag: { x: false, y: false }, points: { size: 7 } },
      scales: { x: { time: false, distr: x.logarithmic ? 3 : 1, range: (_, low, high) => [low, high] },
        y: { range: (_, low, high) => [Math.min(0, low), (high || 1) * 1.05] }, right: { range: (_, _low, high) => [0, (high || 1) * 1.05] } },
      axes: [axis(x.label, horizontal.unit, 2, true, "x"), axis(y.label, scales[0]!.unit, 3, true, "y"),
        ...(right ? [axis(right.label, scales[1]!.unit, 1, false, "right")] : [])],
      series: [{}, ...lines.map((line): uPlot.Series => ({
        scale: line.right ? "right" : "y", stroke: css(`--series-${line.colour % 8}`), width: line.thin ? 1 : 2,
          dash: line.dashed ? [5, 4] : undefined, points: { show: false }, pxAlign: 0,
      })), ...edges.map((line): uPlot.Series => ({ scale: line.right ? "right" : "y", width: 0, points: { show: false }, pxAlign: 0 }))],
      bands: bands.map(({ line }, at) => ({ series: [lines.length + 2 * at + 2, lines.length + 2 * at + 1] as [number, number],
        fill: `${css(`--series-${line.colour % 8}`)}30` })),
      hooks: { setCursor: [(plot) => this.#read(plot.cursor.idx ?? null)], drawAxes: [(plot) => this.#marked(plot)] },
    }, data, this.#plot);
    this.#read(null);
  }

  /** Whether these lines are still the ones that are drawn. */
  shows = (lines: Line[]): boolean => this.#lines === lines;

  #marked({ ctx: pen, bbox, valToPos }: uPlot): void {
    if (this.#mark === undefined || !this.axes.x.logarithmic) return;
    const x = valToPos(this.#mark, "x", true);
    pen.save();
    pen.fillStyle = css("--series-1");
    pen.globalAlpha = 0.55;
    pen.fillRect(x - devicePixelRatio, bbox.top, 2 * devicePixelRatio, bbox.height);
    pen.restore();
  }

  #size(): { width: number; height: number } {
    return { width: Math.max(200, this.#plot.clientWidth), height: this.#plot.clientHeight || 200 };
  }

  #keys(event: KeyboardEvent): void {
    const plot = this.#uplot;
    if (!plot || !["ArrowLeft", "ArrowRight"].includes(event.key)) return;
    event.preventDefault();
    const points = plot.data[0];
    const step = (event.key === "ArrowLeft" ? -1 : 1) * (event.shiftKey ? 20 : 1);
    const index = Math.max(0, Math.min(points.length - 1, (plot.cursor.idx ?? 0) + step));
    plot.setCursor({ left: plot.valToPos(points[index]!, "x"), top: 10 });
  }

  /** The names of the lines, with their values where the cursor is. */
  #read(index: number | null): void {
    const plot = this.#uplot;
    if (!plot) return;
    const { x, y, right } = this.axes;
    const inside = index !== null && (plot.cursor.left ?? -1) >= 0;
    const parts = this.#lines.flatMap((line, at) => {
      const value = inside ? plot.data[at + 1]?.[index] : undefined;
      if (inside ? value === null || value === undefined : line.dashed) return [];
      const side = line.right ? right : y;
      const number = typeof value === "number" ? value * scaledBy(this.#lines, line.right ?? false, side?.unit ?? "") : null;
      const swatch = h("i", { style: `--c: var(--series-${line.colour % 8})`, class: line.dashed ? "dashed" : "" });
      if (number === null) return [h("span", {}, swatch, line.law)];
      const band = this.#bands.findIndex((one) => one.line === line);
      const ends = band < 0 ? [] : [1, 2].map((end) => plot.data[this.#lines.length + 2 * band + end]?.[index!]);
      const scale = scaledBy(this.#lines, line.right ?? false, side?.unit ?? "");
      const [low, high] = ends.map((one) => (typeof one === "number" ? spoken(one * scale, side?.unit ?? "") : null));
      return [h("span", {}, swatch, `${[line.law, line.what].filter(Boolean).join(", ")} `, h("b", {}, spoken(number, side?.unit ?? "")),
        low && high && low !== high ? ` (${low} to ${high})` : null)];
    });
    const place = inside ? spoken(plot.data[0][index]! * (x.logarithmic ? 1
      : scaled(Math.max(...this.#lines.map((line) => largest(line.x))), x.unit).factor), x.unit) : "";
    this.#readout.replaceChildren(h("span", { class: "at" }, ...(place ? [`${x.label} `, h("b", {}, place)] : [this.axes.dashed])), ...parts);
  }
}

const scaledBy = (lines: Line[], right: boolean, unit: string): number =>
  scaled(Math.max(...lines.filter((line) => (line.right ?? false) === right).map((line) => largest(line.y))), unit).factor;

function spoken(value: number, unit: string): string {
  const scale = scaled(Math.abs(value), unit);
  return `${digits(value / scale.factor)}${scale.unit ? ` ${pretty(scale.unit)}` : ""}`;
}
