// Scenes to start from, by trade, with what to look at in each.
import type { About } from "./contract";
import { h, options } from "./dom";
import type { Scene } from "./scene";

/** The name of a scene. */
export const nameOf = (text: string): string | undefined => /^name = "(.*)"/m.exec(text)?.[1];

export class Examples {
  readonly element: HTMLElement;
  readonly #look = h("p", { class: "note", "data-test": "examples.look" });

  constructor(scene: Scene, about: About, open: (text: string, title: string) => void, beside: HTMLElement) {
    const all = about.examples.map((example) => ({ ...example, name: nameOf(example.text) }));
    const menu = h("select", { "aria-label": "examples by trade", "data-test": "examples", onchange: () => {
      const chosen = all[Number(menu.value)];
      if (chosen && menu.value) open(chosen.text, chosen.title);
    } }, ...options([["", "Examples by trade …"], ...all.map(({ title }, index) => [String(index), title] as const)]));
    this.element = h("div", { class: "examples" }, h("div", { class: "row" }, menu, beside), this.#look);
    // the words stay while the example is changed
    scene.onCheck(() => {
      const at = all.findIndex(({ name }) => name !== undefined && name === scene.value("name"));
      menu.value = at < 0 ? "" : String(at);
      this.#look.textContent = all[at]?.look ?? "";
    });
  }
}
