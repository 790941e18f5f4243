// What will happen: the impact in words, numbers and a drawing, its curves, and sliders to play with it. Every answer is of the newest text.
import { type Band, Chart, type Line } from "./charts";
import { cards, meanings, regimes, sentence } from "./cards";
import type { About, Columns, Families, Mistake, Predict, Prediction, SweepBands } from "./contract";
import { bandsOf, bandsOverSpeed, cycle, plain } from "./curves";
import { describe, fold, h } from "./dom";
import { Drawing } from "./drawing";
import type { Context } from "./fields";
import { type Engine, Refusal } from "./engine";
import { type Knob, knobs } from "./knobs";
import { digits, format } from "./units";

/** Laws in common use, which one switch shows. */
const COMMON = ["big-alabo", "ma-liu", "jackson-green", "thornton"];

/** The laws to show beside the scene's own. */
export class Comparison {
  readonly element: HTMLElement;
  readonly #boxes: HTMLInputElement[];
  /** Shows the common ones, or none. */
  readonly switch = h("input", { type: "checkbox", role: "switch", "data-test": "others", onchange: () => this.#all() });

  constructor(about: About, readonly changed: () => void) {
    const labels = [...about.laws.loading, ...about.laws.damped].map(({ name, title }) =>
      h("label", { class: "check", title }, h("input", { type: "checkbox", value: name, "data-test": `compare.${name}`, onchange: () => this.#one() }), ` ${name}`));
    this.#boxes = labels.map((label) => label.querySelector("input")!);
    this.element = fold("Compare laws", "compare", h("div", { class: "checks" }, ...labels));
  }

  #one(): void {
    this.switch.checked = this.laws.length > 0;
    this.changed();
  }

  #all(): void {
    for (const box of this.#boxes) box.checked = this.switch.checked && COMMON.includes(box.value);
    this.changed();
  }

  get laws(): string[] {
    return this.#boxes.filter(({ checked }) => checked).map(({ value }) => value);
  }
}

const NONE: Columns = { columns: [], laws: [] };
/** Speeds at which bands are found: each takes a dozen impacts. */
const SPREAD_SPEEDS = 12;
const NO_BANDS: Families & SweepBands = { families: [], speed: [], bands: [] };

/** An FMU in a line, for who has heard of none, and the way out for who can't use one. */
function whatAnFmuIs(go: (tab: string) => void): HTMLElement {
  return h("p", { class: "note", "data-test": "fmu.what" },
    "An FMU is this contact as one file, which Simulink, Dymola, OpenModelica, Python and many other simulators import. For one that can't, take the ",
    h("button", { type: "button", class: "quiet", "data-test": "fmu.tools", onclick: () => go("tools") }, "numbers for your tool"), ".");
}

interface Doors {
  /** Shows another part of the page. */
  go(tab: string): void;
  examples: HTMLElement;
}

export class Results {
  readonly element: HTMLElement;
  /** The impact in one line, for a phone. */
  readonly summary = h("section", { class: "summary", "aria-label": "the impact in short", "data-test": "summary" });
  readonly #head = h("p", { class: "headline", "data-test": "headline", "aria-live": "polite" }, "…");
  readonly #problem = h("p", { class: "problem", "data-test": "problem", hidden: true });
  readonly #picture = new Drawing();
  readonly #cards = h("dl", { class: "cards" });
  readonly #regimes = h("div", {});
  readonly #meanings = h("dl", { class: "means" });
  readonly #meaningFold = fold("What the regimes mean", "fold.regimes", this.#meanings);
  readonly #deviation = h("input", { type: "text", inputmode: "decimal", autocomplete: "off", "data-test": "deviation", oninput: () => void this.update() });
  readonly #deviationWrong = h("p", { class: "wrong", role: "alert", "data-test": "deviation.wrong" });
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

  constructor(readonly context: Context, readonly engines: { drawing: Engine; spreading: Engine }, readonly show: (mistake: Mistake) => void, doors: Doors) {
    this.#comparison = new Comparison(context.about, () => void this.update());
    this.#knobs = knobs(context);
    const deviation = h("label", { title: "Standard deviation of the softer body's strength. A hardness has its own." }, "Strength uncertain by ",
      this.#deviation, " %");
    this.element = h("div", { class: "results" },
      h("div", { class: "hero" },
        h("div", { class: "told" }, this.#head, this.#problem, doors.examples), this.#picture.element),
      whatAnFmuIs(doors.go), this.#cards, this.#regimes, this.#meaningFold, this.#warnings,
      h("div", { class: "knobs" }, ...this.#knobs.map(({ element }) => element)),
      h("div", { class: "row asked" }, deviation, h("label", { class: "check" }, this.#comparison.switch, " Curves of other laws"), this.#deviationWrong),
      h("div", { class: "charts" }, this.#curve.element, this.#history.element, this.#sweep.element),
      this.#comparison.element, this.#table,
      this.#noteFold,
      fold("As the command line prints it", "fold.words", this.#words));
    context.scene.onCheck(() => void this.update());
  }

  /** The mass of the impact as one writes it, where it is known. */
  get mass(): string | undefined {
    return this.prediction ? `${Number((1e3 * this.prediction.mass).toPrecision(4))} g` : undefined;
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
    const deviation = this.#given();
    try {
      const prediction = await scene.engine.newest("predict", "predict", { text, deviation });
      if (!prediction) return;
      this.#tell(prediction);
      const range = `${Number((prediction.speed / 30).toPrecision(3))}:${Number((prediction.speed * 10).toPrecision(3))}:60`;
      const question = { text, deviation };
      const force = (answer: Columns, from = 0): Line[] => cycle(answer, from);
      void this.#draw("curve", question, laws, force, this.#curve,
        (drawn, bands) => bandsOf(drawn, bands, force, [(line) => !line.dashed, (line) => Boolean(line.dashed && !line.thin)]));
      const history = (answer: Columns, from = 0): Line[] => plain(answer, "time", "force", from);
      void this.#draw("history", question, laws, history, this.#history, (drawn, bands) => bandsOf(drawn, bands, history, [() => true]));
      void this.#draw("sweep", { ...question, sweep: [`speed=${range}`] }, laws,
        (answer, from) => [...plain(answer, "speed", "restitution", from, { what: "restitution" }),
          ...plain(answer, "speed", "dent", from, { what: "dent", right: true, dashed: true })], this.#sweep, bandsOverSpeed);
      try {
        const others = laws.length ? await this.engines.drawing.newest("compare", "predict", { text, laws }) : null;
        this.#compare([...prediction.laws, ...(others?.laws ?? [])]);
      } catch (error) {
        this.#table.replaceChildren(h("p", { class: "wrong", role: "alert", "data-test": "comparison.wrong" }, describe(error)));
      }
    } catch (error) {
      this.#refuse((error instanceof Refusal && error.mistakes[0]?.message) || describe(error));
    }
  }

  /** The uncertainty that somebody types, as a part of one; undefined where there is none. */
  #given(): number | undefined {
    const text = this.#deviation.value.trim().replace(",", ".");
    const value = Number(text);
    const isRight = text === "" || (value >= 0 && value <= 40);
    this.#deviationWrong.textContent = isRight ? "" : "The uncertainty is from 0 to 40 %.";
    this.#deviation.setAttribute("aria-invalid", String(!isRight));
    return text && isRight ? value / 100 : undefined;
  }

  /** Draws the scene's own law and those beside it; then its bands, which take longer. */
  async #draw(method: "curve" | "history" | "sweep", question: { text: string; deviation?: number; sweep?: string[] }, laws: string[],
    lines: (answer: Columns, from: number) => Line[], chart: Chart, bands: (drawn: Line[], answer: Families & SweepBands) => Band[]): Promise<void> {
    const { drawing: engine, spreading } = this.engines;
    try {
      const own = engine.newest(method, method, question);
      // what the others can't is said below them
      const others = laws.length ? engine.newest(`${method} of others`, method, { ...question, laws }).catch(() => NONE) : NONE;
      const few = question.sweep?.map((axis) => axis.replace(/:\d+$/, `:${SPREAD_SPEEDS}`));
      const spread = spreading.newest(method, "bands", { ...question, sweep: few, of: method }).catch(() => NO_BANDS);
      const [first, second] = await Promise.all([own, others]);
      if (!first || !second) return;
      const drawn = lines(first, 0);
      // of the others, no second way through what has been
      const all = [...drawn, ...lines(second, 1).filter(({ thin }) => !thin)];
      chart.draw(all, [], this.prediction?.speed);
      chart.element.hidden = false;
      const answer = await spread;
      const around = answer ? bands(drawn, answer) : [];
      if (around.length && chart.shows(all)) chart.draw(all, around, this.prediction?.speed);
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
    this.#picture.draw(prediction);
    this.#cards.replaceChildren(...cards(law, this.context.about));
    this.#regimes.replaceChildren(...regimes(law, prediction.speed, this.context.about));
    this.#meaningFold.hidden = law.onsets.length === 0;
    this.#meanings.replaceChildren(...meanings(law, this.context.about));
    this.#deviation.placeholder = prediction.deviation === null ? "none" : String(Number((100 * prediction.deviation).toPrecision(2)));
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

