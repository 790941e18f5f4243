// Numbers for a tool without FMU import: the block to paste, and how far it is off.
import { Chart } from "./charts";
import type { About, Outcome, Translate, Translated } from "./contract";
import { describe, fold, h, options } from "./dom";
import { copy } from "./download";
import type { Engine } from "./engine";
import type { Scene } from "./scene";
import { digits, format } from "./units";

type Translation = Translate["translation"];

/** What the tool does over what the law says, as a difference in percent, or as a factor where it is far off. */
function off(law: number, tool: number): string {
  const ratio = tool / law;
  if (ratio < 0.1 || ratio >= 10) return `× ${digits(ratio, 2)}`;
  const percent = Math.round(100 * (ratio - 1));
  return `${percent > 0 ? "+" : percent < 0 ? "−" : "±"}${Math.abs(percent)} %`;
}

/** Far enough off to be marked. */
const FAR = 0.1;

/** The quantities that a tool defines, with their units. */
const QUANTITIES: [key: Exclude<keyof Outcome, "restitution">, name: string, unit: string][] = [
  ["largest_force", "largest force", "N"], ["contact_time", "contact time", "s"], ["depth", "depth", "m"]];

/** The law and the tool at each speed; the one at which the numbers are found is marked. */
function errors({ speeds, wanted, speed }: Translation, { promised, name }: Translated): HTMLElement {
  const defined = QUANTITIES.filter(([key]) => promised.some((one) => typeof one[key] === "number"));
  const cell = (law: number | null, tool: number | null, shown: string): HTMLElement => typeof law === "number" && typeof tool === "number"
    ? h("td", { class: Math.abs(tool / law - 1) > FAR ? "far" : "" }, shown, " ", h("small", {}, off(law, tool))) : h("td", {}, "–");
  const rows = speeds.map((at, row) => {
    const [law, tool] = [wanted[row]!, promised[row]!];
    const spread = tool.most_restitution - tool.least_restitution > 5e-4
      ? ` ${digits(tool.least_restitution, 3)} to ${digits(tool.most_restitution, 3)}` : "";
    return h("tr", { class: Math.abs(at / speed - 1) < 1e-9 ? "met" : "" }, h("th", { scope: "row" }, format(at, "m/s", 3)),
      h("td", {}, digits(law.restitution, 3)), cell(law.restitution, tool.restitution, digits(tool.restitution, 3)),
      h("td", {}, spread || "–"), ...defined.map(([key, , unit]) => cell(law[key], tool[key], format(tool[key], unit, 3))));
  });
  const head = ["speed", "restitution by the law", "by the tool", "range by the step's phase", ...defined.map(([, title]) => `tool's ${title}`)];
  return h("div", { class: "table", tabindex: 0, "data-test": `tools.errors.${name}` }, h("table", {},
    h("thead", {}, h("tr", {}, ...head.map((title) => h("th", { scope: "col" }, title)))), h("tbody", {}, ...rows)));
}

/** The restitution over the speed by the law and by the tool, and both forces. */
function picture({ speeds, wanted, speed }: Translation, { promised, name }: Translated): HTMLElement {
  const chart = new Chart({ title: "The law and the tool over speed", test: `tools.chart.${name}`, x: { label: "speed", unit: "m/s", logarithmic: true },
    y: { label: "restitution", unit: "" }, right: { label: "largest force", unit: "N" }, dashed: "dashed: largest force" });
  const line = (what: string, colour: number, of: Outcome[], key: "restitution" | "largest_force", law: string) => {
    const at = of.flatMap((one, row) => (typeof one[key] === "number" ? [row] : []));
    return { law, what, colour, x: at.map((row) => speeds[row]!), y: at.map((row) => of[row]![key]!), right: key !== "restitution", dashed: key !== "restitution" };
  };
  const both = [["the law", wanted], ["the tool", promised]] as const;
  const lines = both.flatMap(([law, of], colour) => [line("restitution", colour, of, "restitution", law), line("largest force", colour, of, "largest_force", law)]);
  const ends = promised.map((one): [number, number] => [one.least_restitution, one.most_restitution]);
  const [drawn, own] = [lines.filter(({ x }) => x.length > 1), lines[2]!];
  // a chart is as wide as its place
  requestAnimationFrame(() => chart.draw(drawn, [{ line: own, x: speeds, low: ends.map(([low]) => low), high: ends.map(([, high]) => high) }], speed));
  return chart.element;
}

const list = (texts: string[], name: string): HTMLElement => h("ul", { class: "notes", "data-test": name }, ...texts.map((text) => h("li", {}, text)));

export class Tools {
  readonly element: HTMLElement;
  readonly #tool: HTMLSelectElement;
  readonly #units: HTMLSelectElement;
  readonly #step: HTMLInputElement;
  readonly #blocks = h("div", { "data-test": "tools.blocks" });
  readonly #words = h("pre", { tabindex: 0, "data-test": "tools.words" });
  readonly #state = h("p", { class: "wrong", role: "alert", "data-test": "tools.wrong" });

  constructor(readonly scene: Scene, readonly engine: Engine, about: About) {
    const ask = (): void => void this.update();
    this.#tool = h("select", { "data-test": "tools.tool", onchange: ask }, ...options(about.tools.map(({ name, title }) => [name, title])));
    this.#units = h("select", { "data-test": "tools.units", onchange: ask }, ...options([["si", "m, kg, s"], ["mm-t-s", "mm, t, s"]]));
    this.#step = h("input", { type: "text", placeholder: "best", "data-test": "tools.step", oninput: ask });
    this.element = h("div", { class: "tools" },
      h("p", { class: "note" }, "For a tool that imports no FMU: the numbers of its own contact model that fit this scene best, and how far they are off."),
      h("div", { class: "row asked" }, h("label", {}, "Tool ", this.#tool), h("label", {}, "Units ", this.#units), h("label", {}, "Its step ", this.#step)),
      this.#state, this.#blocks, fold("As the command line prints it", "tools.text", this.#words));
    scene.onCheck(ask);
  }

  /** Asks for the numbers, if anybody sees them. */
  async update(): Promise<void> {
    if (this.element.offsetParent === null || !this.scene.right) return;
    const step = this.#step.value.trim() || undefined;
    try {
      const answer = await this.engine.newest("translate", "translate", { text: this.scene.text, tool: this.#tool.value, units: this.#units.value, step });
      if (!answer) return;
      this.#state.textContent = "";
      this.#show(answer);
    } catch (error) {
      this.#state.textContent = describe(error);
      this.#blocks.replaceChildren();
      this.#words.textContent = "";
    }
  }

  #show({ translation, text }: Translate): void {
    this.#blocks.replaceChildren(
      ...translation.ways.map((way) =>
        h("section", {}, h("h2", {}, `${translation.title}: ${way.title}`), h("p", { class: "note" }, way.law),
          h("pre", { tabindex: 0, "data-test": `tools.block.${way.name}` }, way.block),
          h("button", { type: "button", "data-test": `tools.copy.${way.name}`, onclick: () => void copy(way.block) }, "Copy"),
          h("h3", {}, "How far it is off"), errors(translation, way), picture(translation, way), list(way.notes, `tools.notes.${way.name}`))),
      list([...translation.left_out.map((why) => `Left out: ${why}`), ...translation.notes], "tools.notes"),
      h("p", { class: "note" }, `True for ${translation.versions}. Documented at ${translation.reference}`));
    this.#words.textContent = text;
  }
}
