// What will happen: the impact in words and numbers, its curves, and sliders to play with it. Every answer is of the newest text.
import type { About, Columns, Mistake, Predict, Prediction } from "./contract";
import { Chart, type Line } from "./charts";
import { describe, fold, h } from "./dom";
import type { Context } from "./fields";
import { materialOf } from "./fields";
import { type Engine, Refusal } from "./engine";
import { digits, format, inUnit, pretty } from "./units";

const percent = (part: number): string => `${Number((100 * part).toPrecision(3))} %`;

/** The laws to show beside the scene's own. */
export class Comparison {
  readonly element: HTMLElement;
  readonly #boxes: HTMLInputElement[];

  constructor(about: About, changed: () => void) {
    const labels = [...about.laws.loading, ...about.laws.damped].map(({ name, title }) =>
      h("label", { class: "check", title }, h("input", { type: "checkbox", value: name, "data-test": `compare.${name}`, onchange: changed }), ` ${name}`));
    this.#boxes = labels.map((label) => label.querySelector("input")!);
    this.element = fold("Compare laws", "compare", h("div", { class: "checks" }, ...labels));
  }

  get laws(): string[] {
    return this.#boxes.filter(({ checked }) => checked).map(({ value }) => value);
  }
}

interface Knob {
  element: HTMLElement;
  update(): void;
}

/** Units that a slider writes where the scene has none. */
const SLID = ["um", "mm", "m", "MPa", "GPa", "mm/s", "m/s"];

/** A slider over a decade to each side of the scene's value. */
function knob({ scene, about }: Context, test: string, label: string,
  target: () => { path: (string | number)[]; value: number; unit: string; scale?: string } | null): Knob {
  const output = h("output", {});
  const slider = h("input", { type: "range", min: -1, max: 1, step: 0.01, "data-test": `slider.${test}`, "aria-label": label, oninput: move,
    onchange: () => (drag = null) });
  const name = h("span", {}, label);
  let middle = 0;
  /** The drag under way: one step of undo. */
  let drag: symbol | null = null;
  function move(): void {
    const now = target();
    if (!now || !middle) return;
    const value = Number((middle * 10 ** Number(slider.value)).toPrecision(3));
    const written = scene.written(...now.path);
    const sizes = new Map(written?.size ? [[written.unit, written.size]] : (about.units[now.unit] ?? []).filter(([unit]) => SLID.includes(unit)));
    const quantity = now.scale === undefined ? inUnit(value, now.unit, sizes, written?.unit) : { digits: String(value), unit: now.scale };
    scene.type(now.path, { text: String(Number(Number(quantity.digits).toPrecision(3))), unit: quantity.unit }, (drag ??= Symbol()));
    show(value, now);
  }
  function show(value: number, now: { unit: string; scale?: string }): void {
    output.textContent = now.scale === undefined ? format(value, now.unit, 3) : `${value} ${now.scale}`;
  }
  return {
    element: h("label", { class: "knob" }, h("span", { class: "knob-label" }, name, output), slider),
    update() {
      const now = target();
      slider.disabled = !now;
      if (!now) return void (output.textContent = "–");
      const written = scene.written(...now.path);
      if (written) output.textContent = `${written.digits} ${pretty(written.unit)}`;
      else show(now.value, now);
      name.textContent = now.path.at(-1) === "drop_height" ? "Drop height" : label;
      const away = middle ? Math.log10(now.value / middle) : Infinity;
      // not every browser focuses a slider that is dragged
      if (Math.abs(away) <= 1.001 && (drag || document.activeElement === slider)) {
        if (!drag) slider.value = String(away);
        return;
      }
      middle = now.value;
      slider.value = "0";
    },
  };
}

function knobs(context: Context): Knob[] {
  const { scene } = context;
  const at = (path: string[], unit: string): { path: string[]; value: number; unit: string } | null => {
    const value = scene.si(...path);
    return value && value > 0 ? { path, value, unit } : null;
  };
  return [
    knob(context, "speed", "Speed", () => at(["impact", "drop_height"], "m") ?? at(["impact", "speed"], "m/s")),
    knob(context, "radius", "Radius", () => at(["impactor", "radius"], "m")),
    knob(context, "strength", "Target strength", () => {
      const hardness = scene.written("target", "hardness");
      if (hardness) return { path: ["target", "hardness"], value: Number(hardness.digits), unit: "", scale: hardness.unit };
      const given = at(["target", "yield_strength"], "Pa") ?? at(["target", "tensile_strength"], "Pa");
      const material = materialOf(context, ["target", "material"])?.yield_strength;
      return given ?? (material ? { path: ["target", "yield_strength"], value: material, unit: "Pa" } : null);
    }),
  ];
}

/** The impact in one or two sentences. */
function sentence(law: Prediction): string {
  const back = law.rebound_speed > 0 ? `It bounces back with ${percent(law.restitution)} of its speed.` : "It doesn't bounce back.";
  if (law.dent > 0) return `A dent ${format(law.dent, "m", 3)} deep and ${format(2 * law.largest_contact_radius, "m", 3)} wide remains. ${back}`;
  return `No dent remains: the contact stays elastic. ${back}`;
}

function card(test: string, label: string, value: string, more: string): HTMLElement {
  const [number = "", ...unit] = /^\d/.test(value) ? value.split(" ") : [value];
  return h("div", { class: "card", "data-test": `card.${test}` }, h("dt", {}, label),
    h("dd", {}, h("b", {}, number), h("span", {}, unit.join(" ")), h("small", {}, more)));
}

/** The range that the uncertainty of a strength makes of a quantity, before what else a card says. */
function range(law: Prediction, name: string, unit: string): string {
  const [low, high] = law.spread?.[name] ?? [0, 0];
  return high - low > 1e-9 * high ? `${format(low, unit, 3)} to ${format(high, unit, 3)}; ` : "";
}

function cards(law: Prediction): HTMLElement[] {
  const time = law.loading_time + law.unloading_time;
  return [
    card("force", "Largest force", format(law.largest_force, "N"), `${range(law, "largest_force", "N")}at ${format(law.largest_indentation, "m", 3)} of indentation`),
    card("dent", "Dent", law.dent > 0 ? format(law.dent, "m") : "none",
      range(law, "dent", "m") + (law.dent > 0 ? `${format(2 * law.largest_contact_radius, "m", 3)} in diameter` : "no yielding")),
    card("restitution", "Restitution", String(Number(law.restitution.toPrecision(4))), `${range(law, "restitution", "")}leaves with ${format(law.rebound_speed, "m/s", 3)}`),
    card("time", "Contact time", format(time, "s"), `${format(law.loading_time, "s", 3)} in, ${format(law.unloading_time, "s", 3)} out`),
    card("energy", "Energy lost", format(law.energy_lost, "J"), `${percent(law.energy_lost / law.kinetic_energy)} of ${format(law.kinetic_energy, "J", 3)}`),
    card("regime", "Regime", law.regime_name.replace(/ \(.*/, ""), /\((.*)\)/.exec(law.regime_name)?.[1] ?? (law.onsets.length ? "" : "at any speed")),
  ];
}

/** From which speed on what happens, with the scene's own speed. */
function regimes(law: Prediction, speed: number): HTMLElement | null {
  if (law.onsets.length === 0) return null;
  const steps = [{ regime_name: "elastic", speed: 0 }, ...law.onsets];
  const first = format(law.onsets[0]?.speed, "m/s", 3);
  const reached = steps.filter((step) => step.speed <= speed).length - 1;
  return h("ol", { class: "regimes", "data-test": "regimes", "aria-label": "regimes by speed" },
    ...steps.map((step, index) => h("li", { class: index === reached ? "now" : "", "aria-current": index === reached ? "true" : null },
      h("b", {}, step.regime_name), h("small", {}, index ? `from ${format(step.speed, "m/s", 3)}` : `below ${first}`))));
}

/** A curve that turns back, cut where it turns: loading lines, and thin ones for what lies inside. */
function cycle(answer: Columns, from: number): Line[] {
  return answer.laws.flatMap((law, index) => {
    const [x, y] = [law.indentation as number[], law.force as number[]];
    const lines: Line[] = [];
    let start = 0;
    let deepest = -Infinity;
    for (let end = 1; end <= x.length; end++) {
      const turned = end === x.length || (end - start > 1 && Math.sign(x[end]! - x[end - 1]!) * Math.sign(x[start + 1]! - x[start]!) < 0);
      if (!turned) continue;
      const rises = x[end - 1]! > x[start]!;
      const piece = { x: x.slice(start, end), y: y.slice(start, end) };
      if (!rises) {
        piece.x.reverse();
        piece.y.reverse();
      }
      const last = end === x.length;
      if (rises) {
        const beyond = piece.x.findIndex((one) => one > deepest);
        if (deepest > 0) lines.push({ law: law.law, what: "again", colour: from + index, thin: true, dashed: true, x: piece.x.slice(0, beyond),
          y: piece.y.slice(0, beyond) });
        lines.push({ law: law.law, colour: from + index, x: piece.x.slice(Math.max(0, beyond - 1)), y: piece.y.slice(Math.max(0, beyond - 1)) });
        deepest = piece.x.at(-1) ?? deepest;
      } else lines.push({ law: law.law, what: "unloading", colour: from + index, dashed: true, thin: !last, ...piece });
      start = end - 1;
    }
    return joined(lines);
  });
}

/** The pieces of loading as one line. */
function joined(lines: Line[]): Line[] {
  const loading = lines.filter((line) => !line.thin && !line.dashed);
  const [first, ...more] = loading;
  if (!first) return lines;
  return [{ ...first, x: loading.flatMap(({ x }) => x), y: loading.flatMap(({ y }) => y) }, ...lines.filter((line) => !more.includes(line) && line !== first)];
}

const plain = (answer: Columns, x: string, y: string, from: number, more: Partial<Line> = {}): Line[] =>
  answer.laws.map((law, index) => ({ law: law.law, colour: from + index, x: law[x] as number[], y: law[y] as number[], ...more }));

const NONE: Columns = { columns: [], laws: [] };

export class Results {
  readonly element: HTMLElement;
  /** The impact in one line, for a phone. */
  readonly summary = h("section", { class: "summary", "aria-label": "the impact in short", "data-test": "summary" });
  readonly #head = h("p", { class: "headline", "data-test": "headline", "aria-live": "polite" }, "…");
  readonly #problem = h("p", { class: "problem", "data-test": "problem", hidden: true });
  readonly #cards = h("dl", { class: "cards" });
  readonly #regimes = h("div", {});
  readonly #warnings = h("ul", { class: "warnings", "data-test": "warnings" });
  readonly #notes = h("ul", { class: "notes", "data-test": "notes" });
  readonly #noteFold = fold("Notes on this prediction", "fold.notes", this.#notes);
  readonly #table = h("div", { class: "table", tabindex: 0 });
  readonly #words = h("pre", { tabindex: 0, "data-test": "words" });
  readonly #curve = new Chart({ title: "Force over indentation", test: "chart.curve", x: { label: "indentation", unit: "m" },
    y: { label: "force", unit: "N" }, dashed: "dashed: unloading" });
  readonly #history = new Chart({ title: "Force over time", test: "chart.history", x: { label: "time", unit: "s" }, y: { label: "force", unit: "N" }, dashed: "" });
  readonly #sweep = new Chart({ title: "Over speed", test: "chart.sweep", x: { label: "speed", unit: "m/s", logarithmic: true },
    y: { label: "restitution", unit: "" }, right: { label: "dent", unit: "m" }, dashed: "dashed: dent" });
  readonly #comparison: Comparison;
  readonly #knobs: Knob[];
  /** The last prediction, for others to read. */
  prediction: Predict | null = null;
  readonly #listeners: (() => void)[] = [];

  constructor(readonly context: Context, readonly drawing: Engine, readonly show: (mistake: Mistake) => void) {
    this.#comparison = new Comparison(context.about, () => void this.update());
    this.#knobs = knobs(context);
    this.element = h("div", { class: "results" },
      this.#head, this.#problem, this.#cards, this.#regimes, this.#warnings,
      h("div", { class: "knobs" }, ...this.#knobs.map(({ element }) => element)),
      h("div", { class: "charts" }, this.#curve.element, this.#history.element, this.#sweep.element),
      this.#comparison.element, this.#table,
      this.#noteFold,
      fold("As the command line prints it", "fold.words", this.#words));
    context.scene.onCheck(() => void this.update());
  }

  onPrediction(listener: () => void): void {
    this.#listeners.push(listener);
  }

  /** The laws compared, for pictures and tables that are downloaded; undefined if none. */
  get laws(): string[] | undefined {
    const own = this.prediction?.laws[0]?.law;
    return own && this.#comparison.laws.length ? [own, ...this.#comparison.laws.filter((law) => law !== own)] : undefined;
  }

  async update(): Promise<void> {
    const { scene } = this.context;
    if (!scene.right || scene.check.values === null) return this.#refuse(scene.check.mistakes[0]?.message ?? "The text is no TOML.");
    for (const { update } of this.#knobs) update();
    const { text } = scene;
    const laws = this.#comparison.laws;
    try {
      const prediction = await scene.engine.newest("predict", "predict", { text });
      if (!prediction) return;
      this.#tell(prediction);
      const range = `${Number((prediction.speed / 30).toPrecision(3))}:${Number((prediction.speed * 10).toPrecision(3))}:60`;
      void this.#draw("curve", { text }, laws, (answer, from) => cycle(answer, from), this.#curve);
      void this.#draw("history", { text }, laws, (answer, from) => plain(answer, "time", "force", from), this.#history);
      void this.#draw("sweep", { text, sweep: [`speed=${range}`] }, laws,
        (answer, from) => [...plain(answer, "speed", "restitution", from, { what: "restitution" }),
          ...plain(answer, "speed", "dent", from, { what: "dent", right: true, dashed: true })], this.#sweep);
      try {
        const others = laws.length ? await this.drawing.newest("compare", "predict", { text, laws }) : null;
        this.#compare([...prediction.laws, ...(others?.laws ?? [])]);
      } catch (error) {
        this.#table.replaceChildren(h("p", { class: "wrong", role: "alert", "data-test": "comparison.wrong" }, describe(error)));
      }
    } catch (error) {
      this.#refuse((error instanceof Refusal && error.mistakes[0]?.message) || describe(error));
    }
  }

  /** Draws the scene's own law, then those beside it. */
  async #draw(method: "curve" | "history" | "sweep", question: { text: string; sweep?: string[] }, laws: string[],
    lines: (answer: Columns, from: number) => Line[], chart: Chart): Promise<void> {
    const engine = this.drawing;
    try {
      const own = engine.newest(method, method, question);
      // what the others can't is said below them
      const others = laws.length ? engine.newest(`${method} of others`, method, { ...question, laws }).catch(() => NONE) : NONE;
      const [first, second] = await Promise.all([own, others]);
      if (first && second) chart.draw([...lines(first, 0), ...lines(second, 1)], this.prediction?.speed);
      chart.element.hidden = false;
    } catch {
      chart.element.hidden = true; // not every scene has every chart: the prediction says why
    }
  }

  #tell(prediction: Predict): void {
    const law = prediction.laws[0];
    if (!law) return;
    this.prediction = prediction;
    this.element.classList.remove("stale");
    this.#problem.hidden = true;
    this.#head.textContent = sentence(law);
    this.summary.textContent = [format(law.largest_force, "N", 3), law.dent > 0 ? `dent ${format(law.dent, "m", 3)}` : "no dent",
      `restitution ${digits(law.restitution, 3)}`].join(" · ");
    this.#cards.replaceChildren(...cards(law));
    this.#regimes.replaceChildren(...[regimes(law, prediction.speed)].filter((one) => one !== null));
    this.#warnings.replaceChildren(...law.warnings.map((text) => h("li", {}, text)));
    this.#noteFold.hidden = prediction.notes.length === 0;
    this.#notes.replaceChildren(...prediction.notes.map((text) => h("li", {}, text)));
    this.#words.textContent = prediction.text;
    for (const listener of this.#listeners) listener();
  }

  #refuse(message: string): void {
    this.element.classList.add("stale");
    this.summary.textContent = message;
    this.#problem.hidden = false;
    const mistake = this.context.scene.check.mistakes[0];
    this.#problem.classList.toggle("told", mistake !== undefined); // above the form
    this.#problem.replaceChildren(h("span", {}, message),
      mistake ? h("button", { type: "button", "data-test": "problem.show", onclick: () => this.show(mistake) }, `Line ${mistake.line}`) : "");
  }

  #compare(laws: Prediction[]): void {
    const columns: [string, (law: Prediction) => string][] = [
      ["largest force", (law) => format(law.largest_force, "N")], ["indentation", (law) => format(law.largest_indentation, "m")],
        ["dent", (law) => format(law.dent, "m")],
      ["restitution", (law) => String(Number(law.restitution.toPrecision(4)))], ["contact time", (law) => format(law.loading_time + law.unloading_time, "s")],
    ];
    this.#table.replaceChildren(...(laws.length > 1 ? [h("table", { "data-test": "comparison" },
      h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "law"), ...columns.map(([title]) => h("th", { scope: "col" }, title)))),
      h("tbody", {}, ...laws.map((law, index) =>
        h("tr", {}, h("th", { scope: "row" }, h("i", { style: `--c: var(--series-${index % 8})` }), law.law),
          ...columns.map(([, show]) => h("td", {}, show(law)))))))] : []));
  }
}

