// A scene by link, by file, and by dropping a file anywhere.
import type { About } from "./contract";
import { describe, fold, h, toast } from "./dom";
import { copy } from "./download";
import { type Engine, through } from "./engine";
import { nameOf } from "./examples";
import type { Scene } from "./scene";

/** The scene in an address: deflated, in the alphabet of addresses. */
export async function packed(text: string): Promise<string> {
  const bytes = new Uint8Array(await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw")).arrayBuffer());
  return btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

export async function unpacked(fragment: string): Promise<string> {
  const binary = atob(fragment.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = through(Uint8Array.from(binary, (character) => character.charCodeAt(0)), new DecompressionStream("deflate-raw"));
  return new TextDecoder("utf-8", { fatal: true }).decode(await bytes.arrayBuffer());
}

/** The scene that the page's address has, if any: behind `#scene=` all of it, behind `#example=` the name of an example. */
export async function linked(examples: About["examples"]): Promise<string | null> {
  const [, kind, value] = /^#(scene|example)=(.+)$/.exec(location.hash) ?? [];
  if (!kind || !value) return null;
  try {
    return kind === "scene" ? await unpacked(value) : exampleOf(examples, value);
  } catch (error) {
    toast(kind === "scene" ? "The scene in this link is damaged: was it cut?" : describe(error));
    return null;
  }
}

function exampleOf(examples: About["examples"], name: string): string {
  const found = examples.find(({ text }) => nameOf(text) === name);
  if (!found) throw new Error(`There is no example ${name}; there are ${examples.map(({ text }) => nameOf(text)).join(", ")}.`);
  return found.text;
}

export class Share {
  readonly element: HTMLElement;
  readonly #link = h("textarea", { readonly: true, rows: 4, "aria-label": "link to this scene", "data-test": "link", onfocus: () => this.#link.select() });

  #timer = 0;

  copy = (): Promise<void> => copy(this.#link.value);

  constructor(scene: Scene, version: string) {
    this.element = h("div", { class: "share" },
      h("p", {}, "This link holds the whole scene. Whoever opens it sees what you see. The address of this page has it, too, so a reload loses nothing."), this.#link,
      location.protocol === "file:" ? h("p", { class: "note", "data-test": "link.file" },
        "This page is a file, so the link opens on this computer only. Elsewhere, put what it has from # on behind the address of another brinell.html.") : "",
      h("div", { class: "row" }, h("button", { type: "button", class: "primary", "data-test": "link.copy",
        onclick: () => void this.copy() }, "Copy link")),
      h("p", { class: "note" }, "Nothing is ever sent anywhere: a browser keeps what stands behind the # to itself, and this page forbids itself every connection (its content security policy says default-src 'none'). It works without a network; save it and keep it."),
      h("p", { class: "note" }, `Brinell ${version}`),
      fold("Licenses of what this page is made of", "fold.licenses", h("pre", { tabindex: 0 }, document.getElementById("licenses")?.textContent ?? "")));
    let first: string | null = null;
    scene.onCheck(async () => {
      const text = scene.text;
      const fragment = await packed(text);
      if (text !== scene.text) return;
      this.#link.value = `${location.href.replace(/#.*/, "")}#scene=${fragment}`;
      if (text === (first ??= text)) return;
      clearTimeout(this.#timer); // browsers allow few changes of the address in a row
      this.#timer = window.setTimeout(() => history.replaceState(null, "", `#scene=${fragment}`), 500);
    });
  }
}

async function sceneIn(file: File, engine: Engine, now: string): Promise<string> {
  const bytes = async (): Promise<Uint8Array<ArrayBuffer>> => new Uint8Array(await file.arrayBuffer());
  if (/\.fmu$/i.test(file.name)) return (await engine.ask("scene_of", {}, await bytes())).ok.text;
  if (/\.(csv|tsv|txt|dat)$/i.test(file.name)) return (await engine.ask("table", { text: now }, await bytes())).ok.text;
  return file.text();
}

/** Opens files that are dropped or chosen; a table is the tensile test or the loading curve of the scene that is there `now`. */
export function files(engine: Engine, now: () => string, open: (text: string, name: string) => void): { choose(): void } {
  const take = async (file: File | undefined): Promise<void> => {
    if (!file) return;
    try {
      open(await sceneIn(file, engine, now()), file.name);
    } catch (error) {
      toast(`${file.name}: ${describe(error)}`);
    }
  };
  const input = h("input", { type: "file", accept: ".toml,.fmu,.csv,.tsv,.txt,.dat", hidden: true, "data-test": "file",
    onchange: () => (void take(input.files?.[0]), (input.value = "")) });
  const shade = h("div", { class: "drop", hidden: true, "data-test": "drop" }, h("p", {}, "Drop a scene (.toml), an FMU, or a table (.csv): a tensile test, or depth and force"));
  document.body.append(input, shade);
  addEventListener("dragover", (event) => {
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    shade.hidden = false;
  });
  addEventListener("dragleave", (event) => event.relatedTarget === null && (shade.hidden = true));
  const drop = (event: DragEvent): void => {
    if (!event.dataTransfer?.files.length) return;
    event.preventDefault();
    event.stopPropagation(); // before the editor takes the file's text
    shade.hidden = true;
    void take(event.dataTransfer.files[0]);
  };
  addEventListener("drop", drop, true);
  return { choose: () => input.click() };
}
