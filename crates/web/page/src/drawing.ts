// The contact to scale: ball, plate and dent, whole, at their deepest and after. Both directions have the same scale, which is said.
import type { Predict } from "./contract";
import { h } from "./dom";
import { digits, format } from "./units";

/** CSS pixels in a metre: 96 in an inch. */
const LIFE_SIZE = 96 / 0.0254;
/** Points of a surface to each side of the middle. */
const POINTS = 90;
const GAP = 10;
const TITLE = 17;

type Curve = (r: number) => number;

/** How far a sphere falls away from its tangent plane; 0 radius is a plane, a radius below 0 a socket. */
const fall = (radius: number): Curve => (r) => radius === 0 ? 0 : Math.sign(radius) * (Math.abs(radius) - Math.sqrt(radius * radius - r * r));

/** Hertz's displacement outside the contact over that at its edge, at `s` contact radii from the middle. */
const beside = (s: number): number => ((2 - s * s) * Math.asin(1 / s) + Math.sqrt(s * s - 1)) / (Math.PI / 2);

/** The surfaces of ball and target in metres above the target's untouched surface. */
interface Surfaces {
  ball: Curve;
  target: Curve;
}

/** At the deepest: what the contact takes of the gap is divided as the dent is, and as the compliances are. */
function deepest({ shape, laws }: Predict): Surfaces {
  const { largest_indentation: depth, largest_contact_radius: a, dent } = laws[0]!;
  const [ball, target] = [fall(shape.radii[0]), fall(shape.radii[1])];
  const overlap: Curve = (r) => depth - ball(r) - target(r);
  const taken: Curve = (r) => Math.abs(r) <= a ? overlap(r) : overlap(a) * beside(Math.abs(r) / a);
  const share = (body: 0 | 1): number => (shape.dent[body] * dent + shape.elastic[body] * (depth - dent)) / depth;
  return { ball: (r) => ball(r) - depth + share(0) * taken(r), target: (r) => -target(r) - share(1) * taken(r) };
}

/** After it, with the ball lifted. */
function after({ shape, laws }: Predict, lift: number): Surfaces {
  const { largest_contact_radius: a, dent } = laws[0]!;
  const [ball, target] = [fall(shape.radii[0]), fall(shape.radii[1])];
  const left: Curve = (r) => Math.abs(r) < a ? dent * (1 - (r / a) ** 2) : 0;
  return { ball: (r) => lift + ball(r) + shape.dent[0] * left(r), target: (r) => -target(r) - shape.dent[1] * left(r) };
}

function svg(tag: string, attributes: { [name: string]: string | number }, ...children: (Node | string)[]): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

const label = (x: number, y: number, text: string, more: { [name: string]: string } = {}): SVGElement => svg("text", { x, y, ...more }, text);

/** A round length that takes about a quarter of `width` metres. */
function rounded(width: number): number {
  const power = 10 ** Math.floor(Math.log10(width / 4));
  return power * ([5, 2, 1].find((step) => step * power <= width / 4) ?? 1);
}

interface Panel {
  x: number;
  y: number;
  width: number;
  height: number;
  /** Pixels in a metre. */
  scale: number;
  /** The height in the panel of the untouched surface. */
  ground: number;
}

/** Both bodies in a panel, cut off at its edges. */
function bodies({ x, y, width, height, scale, ground }: Panel, { ball, target }: Surfaces, clip: string): SVGElement {
  const across = (r: number): number => x + width / 2 + r * scale;
  const up = (metres: number): number => y + ground - metres * scale;
  const line = (curve: Curve): string[] => Array.from({ length: 2 * POINTS + 1 }, (_, index) => {
    const r = ((index - POINTS) / POINTS) * (width / 2 / scale);
    const z = curve(r);
    return Number.isFinite(z) ? `${across(r).toFixed(2)},${up(z).toFixed(2)}` : "";
  }).filter(Boolean);
  const area = (curve: Curve, edge: number, name: string): SVGElement => {
    const points = line(curve);
    const ends = [points.at(-1), points[0]].map((point) => `${point?.split(",")[0]},${edge}`);
    return svg("polygon", { points: [...points, ...ends].join(" "), class: name });
  };
  return svg("g", { "clip-path": `url(#${clip})` }, area(target, y + height + 4, "target"), area(ball, y - 4, "ball"));
}

function bar(x: number, y: number, width: number, scale: number): SVGElement[] {
  const length = rounded(width / scale);
  return [svg("path", { d: `M${x},${y - 3}v3h${length * scale}v-3`, class: "bar" }), label(x + length * scale + 5, y + 1, format(length, "m", 1))];
}

const times = (scale: number): string => `${digits(scale / LIFE_SIZE, 2)}×`;

export class Drawing {
  readonly element = h("figure", { class: "drawing", "data-test": "drawing" });
  readonly #plot = h("div", { class: "scaled" });
  readonly #caption = h("figcaption", { class: "note", "data-test": "drawing.caption" });
  #shown: Predict | null = null;
  #width = 0;

  constructor() {
    this.element.append(this.#plot, this.#caption);
    new ResizeObserver(() => this.#plot.clientWidth !== this.#width && this.#shown && this.draw(this.#shown)).observe(this.#plot);
  }

  draw(prediction: Predict): void {
    this.#shown = prediction;
    const width = (this.#width = this.#plot.clientWidth);
    const law = prediction.laws[0];
    if (!width || !law) return;
    const { shape } = prediction;
    const a = law.largest_contact_radius;
    const small = Math.min(104, width * 0.27);
    const close = { x: small + GAP, width: width - small - GAP, height: 78 };
    const scale = close.width / (2.9 * a);
    const whole = 0.62 * small / (2 * shape.radii[0]);
    const height = 2 * (TITLE + close.height) + GAP;
    const tall = height - TITLE;
    const panels: [Panel, Surfaces, string, string][] = [
      [{ x: 0, y: TITLE, width: small, height: tall, scale: whole, ground: 0.72 * tall }, deepest(prediction), `whole, ${times(whole)}`, "whole"],
      [{ ...close, y: TITLE, scale, ground: 0.52 * close.height }, deepest(prediction),
        `deepest, ${times(scale)}: ${format(law.largest_indentation, "m", 3)} in`, "deepest"],
      [{ ...close, y: 2 * TITLE + close.height + GAP, scale, ground: 0.52 * close.height }, after(prediction, (0.3 * close.height) / scale),
        law.dent > 0 ? `after: ${format(law.dent, "m", 3)} deep, ${format(2 * a, "m", 3)} wide` : "after: no dent", "after"],
    ];
    const parts = panels.flatMap(([panel, surfaces, title, name]) => [
      svg("clipPath", { id: `clip-${name}` }, svg("rect", { x: panel.x, y: panel.y, width: panel.width, height: panel.height, rx: 6 })),
      svg("rect", { x: panel.x, y: panel.y, width: panel.width, height: panel.height, rx: 6, class: "sky" }),
      name === "whole" ? this.#whole(panel, prediction) : bodies(panel, surfaces, `clip-${name}`),
      label(panel.x + 1, panel.y - 5, title),
    ]);
    const last = panels[2]![0];
    parts.push(...bar(last.x + 8, last.y + last.height - 8, last.width, scale), ...bar(8, TITLE + tall - 8, small, whole));
    const words = panels.map(([, , title]) => title).join("; ");
    this.#plot.replaceChildren(svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "data-test": "drawing.svg",
      "data-scale": scale, "aria-label": `The contact to scale: ${words}` }, ...parts));
    this.#caption.textContent = this.#says(prediction, law.largest_indentation * scale < 1.5);
  }

  /** The whole ball at its deepest, on the target. */
  #whole({ x, y, width, height, scale, ground }: Panel, { shape, laws }: Predict): SVGElement {
    const [ball, target] = shape.radii;
    const [middle, floor] = [x + width / 2, y + ground];
    const circle = (radius: number, cy: number, name: string): SVGElement => svg("circle", { cx: middle, cy, r: radius * scale, class: name });
    const plate = target > 0 ? circle(target, floor + target * scale, "target")
      : svg("path", { d: `M${x},${y + height + 4}V${target < 0 ? y : floor}H${x + width}V${y + height + 4}z`, class: "target" });
    const socket = target < 0 ? [circle(-target, floor + target * scale, "sky")] : [];
    return svg("g", { "clip-path": "url(#clip-whole)" }, plate, ...socket, circle(ball, floor - (ball - laws[0]!.largest_indentation) * scale, "ball"));
  }

  #says({ shape, laws }: Predict, isThin: boolean): string {
    const { dent } = laws[0]!;
    const where = dent > 0 && shape.dent[0] > 0 ? (shape.dent[1] > 0 ? "Each body has half of the dent. " : "The ball is softer: the dent is in it. ") : "";
    const rough = dent > 0 && !shape.dent_is_known ? "Both bodies yield; the drawing gives the whole dent to the softer one. " : "";
    return `To scale, in both directions alike${isThin ? "; the contact is flatter than a line" : ""}. ${where}${rough}The rim is drawn level.`;
  }
}
