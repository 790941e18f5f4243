// Numbers for a tool without FMU import: the block to paste, and how far it is off.
import type { About, Translate } from "./contract";
import { describe, h, options } from "./dom";
import { copy } from "./download";
import type { Engine } from "./engine";
import type { Scene } from "./scene";

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
      this.#state, this.#blocks, h("h2", {}, "How far it is off"), this.#words);
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
      ...translation.ways.map(({ title, block, name }) =>
        h("section", {}, h("h2", {}, `${translation.title}: ${title}`), h("pre", { tabindex: 0, "data-test": `tools.block.${name}` }, block),
          h("button", { type: "button", "data-test": `tools.copy.${name}`, onclick: () => void copy(block) }, "Copy"))),
      h("p", { class: "note" }, `True for ${translation.versions}. Documented at ${translation.reference}`));
    this.#words.textContent = text;
  }
}
