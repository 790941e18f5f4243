// The page: form and text of a scene, what will happen, and what can be taken away. All is computed here; nothing is sent.
//
// Every element that can be used has a `data-test`:
//   PATH, PATH.unit, PATH.scale     a key of the scene: impactor.radius, impact.drop_height.unit, target.hardness.scale
//   PATH.wrong                      the exporter's message at a key
//   PATH.numbers, PATH.source, PATH.warning     a material's numbers, where they are from, and what to say of it
//   impactor.body, target.strength, impact.by, friction.kind, law.loss, target.rate.kind, coupling.kind   choices between keys
//   target.material.list            the list of materials, with `data-value` on each entry
//   law.NAME, compare.NAME          a law of the scene; one to compare
//   contact.add, contact.0.remove   entries of several contacts, and body.* of shared bodies
//   fold.*, *.more, law.others      folded parts; mistake, mistake.show: the message of a wrong scene
//   editor                          the text of the scene
//   examples, examples.look, share, fmu.what, fmu.tools     the first lines of the result
//   drawing, drawing.svg, drawing.caption     the contact to scale; data-scale has the pixels of a metre
//   headline, summary, card.*, band.*, deviation, others, regime.means, problem, problem.show, warnings, notes, words, comparison, comparison.wrong, regimes       what will happen
//   chart.curve, chart.history, chart.sweep with .plot and .readout; slider.speed, slider.radius, slider.strength, each with .from, .to and .wrong
//   tab.NAME, panel.NAME            result, try, download, tools, link; on a phone also form and text
//   undo, redo, open, new, file, export       the head of the page; file is the hidden input
//   platform.FOLDER, download.*     fmu, toml, python, rest, copy, csv, history, svg, state; python.says
//   try.*, way.NAME, tools.tool, .units, .step, .block.WAY, .errors.WAY, .chart.WAY, .notes.WAY, .text, .words, link, link.copy, link.file, toast
import "./locale";
import type { Mistake } from "./contract";
import { describe, h, toast } from "./dom";
import { Download } from "./download";
import { Editor } from "./editor";
import { compiled, Engine } from "./engine";
import { Examples } from "./examples";
import type { Context } from "./fields";
import { Form } from "./form";
import { Results } from "./results";
import { Scene } from "./scene";
import { Schema } from "./schema";
import { files, linked, Share } from "./share";
import { Tools } from "./tools";
import { TryIt } from "./tryit";
import "./style.css";

const phone = matchMedia("(max-width: 760px)");

interface Tab {
  name: string;
  label: string;
  /** On a phone. */
  short?: string;
  panel: HTMLElement;
  shown?: () => void;
}

/** The parts of the page; on a wide screen form and text are always there. */
function tabs(list: Tab[]): { bar: HTMLElement; select(name: string): void } {
  const buttons = list.map(({ name, label, short, panel }) => {
    Object.assign(panel, { id: `panel-${name}` });
    panel.dataset.test = `panel.${name}`;
    panel.classList.add("panel");
    return h("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": panel.id, "data-test": `tab.${name}`, class: `tab-${name}`,
      onclick: () => select(name) }, h("span", { class: "long" }, label), h("span", { class: "short" }, short ?? label));
  });
  const bar = h("div", { class: "tabs", role: "tablist", "aria-label": "parts", onkeydown: (event: KeyboardEvent) => {
    const visible = buttons.filter((button) => button.offsetParent !== null);
    const at = visible.findIndex((button) => button === document.activeElement);
    const goal = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: -1 }[event.key];
    if (goal === undefined || at < 0) return;
    event.preventDefault();
    const next = visible[(goal + visible.length) % visible.length];
    next?.focus();
    next?.scrollIntoView({ block: "nearest", inline: "nearest" });
    next?.click();
  } }, ...buttons);
  function select(name: string): void {
    document.body.dataset.tab = name;
    list.forEach((tab, index) => {
      const now = tab.name === name;
      tab.panel.classList.toggle("now", now);
      buttons[index]!.setAttribute("aria-selected", String(now));
      buttons[index]!.tabIndex = now ? 0 : -1;
      if (now) tab.shown?.();
    });
  }
  return { bar, select };
}

async function start(): Promise<void> {
  const module = await compiled();
  // one for each change, one for curves, one for their bands, one for what takes longer: none waits for another
  const [engine, drawing, spreading, workshop] = [new Engine(module), new Engine(module), new Engine(module), new Engine(module)] as const;
  const [about, root] = await Promise.all([workshop.ask("about"), engine.ask("schema")]);
  const given = await linked(about.ok.examples);
  const scene = new Scene(engine);
  const context: Context = { scene, schema: new Schema(root.ok), about: about.ok };

  const text = h("section", { "aria-label": "scene file" });
  const show = (mistake: Mistake): void => {
    if (phone.matches) select("text");
    editor.show(mistake);
  };
  const open = (opened: string, name: string): void => {
    editor.open(opened);
    toast(`${name} is open. Undo brings back what was here.`);
  };
  const share = new Share(scene, about.ok.version);
  const link = h("button", { type: "button", "data-test": "share", title: "Copy a link that has the whole scene", onclick: () => void share.copy() }, "Copy link");
  const examples = new Examples(scene, about.ok, open, link);
  const results = new Results(context, { drawing, spreading }, show, { go: (tab) => select(tab), examples: examples.element });
  const form = new Form(context, show, () => results.mass);
  const download = new Download(scene, results, workshop, about.ok);
  const tryit = new TryIt(scene, results, module);
  const tools = new Tools(scene, workshop, about.ok);
  const panel = (label: string, child: HTMLElement): HTMLElement => h("section", { role: "tabpanel", "aria-label": label, tabindex: 0 }, child);
  const parts: Tab[] = [
    { name: "form", label: "Bodies", panel: h("section", { "aria-label": "bodies and impact" }, form.element) },
    { name: "text", label: "Scene", panel: text },
    { name: "result", label: "What will happen", short: "Result", panel: panel("What will happen", results.element) },
    { name: "tools", label: "Numbers for your tool", short: "Tools", panel: panel("Numbers for your tool", tools.element), shown: () => void tools.update() },
    { name: "try", label: "Try it", short: "Try", panel: panel("Try it", tryit.element), shown: () => void tryit.shown() },
    { name: "download", label: "Download", short: "FMU", panel: panel("Download", download.element) },
    { name: "link", label: "Link", panel: panel("Link", share.element) },
  ];
  const { bar, select } = tabs(parts);
  const button = (test: string, label: string, title: string, act: () => void, more = ""): HTMLButtonElement =>
    h("button", { type: "button", "data-test": test, title, class: more, onclick: act }, label);
  const chooser = files(workshop, () => scene.text, open);
  const undo = button("undo", "Undo", "Undo (Ctrl+Z)", () => editor.undo());
  const redo = button("redo", "Redo", "Redo (Ctrl+Y)", () => editor.redo());
  const head = h("header", {},
    h("h1", {}, h("span", { class: "mark", "aria-hidden": "true" }), "Brinell"),
      h("p", { class: "tagline" }, "What an impact does to metal, and its FMU. Nothing leaves this page."),
    h("div", { class: "row" }, undo, redo, button("new", "New", "Start with a commented scene",
      async () => editor.open((await engine.ask("new", { name: "ball" })).ok.text)),
      button("open", "Open", "Open a scene (.toml), an FMU, a tensile test (.csv) or a curve of depth and force (.csv); or drop one anywhere", () => chooser.choose()),
        button("export", "FMU", "Make the FMU and download it", () => (select("download"), void download.fmu()), "primary")));
  const [formPart, textPart, ...others] = parts.map(({ panel }) => panel);
  document.body.append(head, results.summary, h("main", {}, formPart!, h("nav", { "aria-label": "parts of the page" }, bar),
    h("div", { class: "middle" }, ...others), textPart!), h("pre", { class: "printed", "aria-hidden": "true" }));
  const editor = new Editor(text, scene, context.schema, about.ok, given ?? about.ok.examples[0]!.text);
  select("result");

  scene.onCheck(() => {
    undo.disabled = editor.depth.undo === 0;
    redo.disabled = editor.depth.redo === 0;
    document.title = `${String(scene.value("name") ?? "scene")} – Brinell`;
    document.querySelector(".printed")!.textContent = scene.text;
  });
  addEventListener("hashchange", async () => {
    const other = await linked(about.ok.examples);
    if (other !== null) editor.open(other);
  });
  addEventListener("keydown", (event) => {
    const typing = event.target instanceof Element && event.target.closest(".cm-editor, textarea");
    if (typing || !(event.ctrlKey || event.metaKey) || !/^[zy]$/i.test(event.key)) return;
    event.preventDefault();
    if (event.key.toLowerCase() === "y" || event.shiftKey) editor.redo();
    else editor.undo();
  });
}

start().catch((error: unknown) => document.body.append(h("p", { class: "problem", role: "alert" }, `Brinell can't start here: ${describe(error)}`)));
