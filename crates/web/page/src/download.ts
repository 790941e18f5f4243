// What can be taken away: the FMU for the platforms chosen, the scene, a Python snippet that runs it, curves.
import type { About } from "./contract";
import { describe, h, save, toast } from "./dom";
import { embedded, type Engine } from "./engine";
import type { Results } from "./results";
import type { Scene } from "./scene";

type Platform = About["platforms"][number];

const TITLES: { [folder: string]: string } = {
  win64: "Windows", linux64: "Linux, Intel and AMD", darwin64: "macOS", "aarch64-linux": "Linux, ARM", "aarch64-darwin": "macOS, Apple silicon only", "c-code": "C code",
};

/** The folder of the visitor's own system. */
function ownFolder(): string {
  const system = navigator.userAgent;
  if (/Mac|iPhone|iPad/.test(system)) return "darwin64";
  return /Linux|X11|CrOS/.test(system) && !/Android/.test(system) ? "linux64" : "win64";
}

export class Download {
  readonly element: HTMLElement;
  readonly #boxes: HTMLInputElement[];
  readonly #state = h("p", { class: "note", role: "status", "data-test": "download.state" });
  readonly #python = h("pre", { tabindex: 0, "data-test": "python" });
  readonly #given = new Set<string>();

  constructor(readonly scene: Scene, readonly results: Results, readonly engine: Engine, readonly about: About) {
    const own = ownFolder();
    const here = about.platforms.filter(({ targets }) => targets.every((triple) => document.getElementById(`library:${triple}.br`)));
    const labels = here.map(({ folder, title }) =>
      h("label", { class: "check" }, h("input",
        { type: "checkbox", value: folder, checked: folder === own || folder === "win64", "data-test": `platform.${folder}` }),
          ` ${title ?? TITLES[folder] ?? folder}`, h("small", {}, folder === own ? ` ${folder}, yours` : ` ${folder}`)));
    this.#boxes = labels.map((label) => label.querySelector("input")!);
    const button = (test: string, label: string, act: () => void): HTMLElement =>
      h("button", { type: "button", "data-test": `download.${test}`, onclick: act }, label);
    this.element = h("div", { class: "download" },
      h("h2", {}, "FMU"), h("p", { class: "note" },
        "FMI 2.0 for co-simulation. It is made here, in your browser, and is the same to the last byte as that of the command line."),
      h("div", { class: "checks" }, ...labels),
        h("div", { class: "row" }, h("button", { type: "button", class: "primary", "data-test": "download.fmu", onclick: () => void this.fmu() },
          "Download FMU")), this.#state,
      h("h2", {}, "Run it in Python"), h("p", { class: "note" }, "The ball hits and leaves. Needs fmpy: pip install fmpy"), this.#python,
      h("div", { class: "row" }, button("python", "Download .py", () => save(`${this.#name()}.py`, this.#python.textContent ?? "", "text/x-python")),
        button("copy", "Copy", () => void copy(this.#python.textContent ?? ""))),
      h("h2", {}, "Scene and curves"),
      h("div", { class: "row" },
        button("toml", "Scene .toml", () => save(`${this.#name()}.toml`, scene.text, "application/toml")),
        button("csv", "Curve .csv", () => void this.#file("csv", "curve")),
          button("history", "History .csv", () => void this.#file("csv", "history")),
            button("svg", "Picture .svg", () => void this.#file("picture", "curve"))));
    results.onPrediction(() => (this.#python.textContent = this.#snippet()));
  }

  #name = (): string => String(this.scene.value("name") ?? "scene");

  async fmu(): Promise<void> {
    try {
      const platforms = this.#boxes.filter(({ checked }) => checked).map(({ value }) => value);
      this.#state.textContent = "Making the FMU …";
      for (const triple of new Set(platforms.flatMap((folder) =>
        this.about.platforms.find((one) => one.folder === folder)?.targets ?? []))) await this.#give(triple);
      const { ok, bytes } = await this.engine.ask("export", { text: this.scene.text, platforms });
      save(ok.name, bytes, "application/zip");
      this.#state.textContent = `${ok.name}, ${Math.ceil(bytes.length / 1024)} kB, for ${platforms.join(", ")}.`;
    } catch (error) {
      this.#state.textContent = describe(error);
      toast(describe(error));
    }
  }

  /** Hands the libraries of a target to the exporter, once. */
  async #give(triple: Platform["targets"][number]): Promise<void> {
    if (this.#given.has(triple)) return;
    const [list, archive] = [embedded(`library:${triple}.json`), embedded(`library:${triple}.br`)];
    const both = new Uint8Array(list.length + archive.length);
    both.set(list);
    both.set(archive, list.length);
    await this.engine.ask("libraries", { triple, list: list.length }, both);
    this.#given.add(triple);
  }

  async #file(method: "csv" | "picture", of: string): Promise<void> {
    try {
      const { ok } = await this.engine.ask(method, { text: this.scene.text, laws: this.results.laws, of });
      if ("csv" in ok) save(`${this.#name()}_${of}.csv`, ok.csv, "text/csv");
      else save(`${this.#name()}.svg`, ok.svg, "image/svg+xml");
    } catch (error) {
      toast(describe(error));
    }
  }

  #snippet(): string {
    const prediction = this.results.prediction;
    const speed = prediction?.speed ?? 1;
    const mass = prediction?.mass ?? 1;
    const law = prediction?.laws[0];
    const step = Number((((law?.loading_time ?? 1e-5) + (law?.unloading_time ?? 1e-5)) / 200).toPrecision(2));
    const force = this.scene.value("coupling") === undefined ? "force" : "mean_force";
    return this.scene.value("contact") !== undefined ? this.#several() : `from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

description = read_model_description("${this.#name()}.fmu")
variables = {variable.name: variable.valueReference for variable in description.modelVariables}
unit = FMU2Slave(guid=description.guid, unzipDirectory=extract("${this.#name()}.fmu"),
                 modelIdentifier=description.coSimulation.modelIdentifier)
unit.instantiate()
unit.setupExperiment()
unit.enterInitializationMode()
unit.exitInitializationMode()

mass, speed, step, time = ${mass}, ${speed}, ${step}, 0.0    # kg, m/s, s
largest = 0.0
while True:
    unit.setReal([variables["indentation_rate"]], [speed])
    unit.doStep(currentCommunicationPoint=time, communicationStepSize=step)
    [force] = unit.getReal([variables["${force}"]])
    largest = max(largest, force)
    speed -= force / mass * step
    time += step
    if force == 0.0 and speed < 0.0:
        break
print(f"largest force {largest:.4g} N, leaves with {-speed:.4g} m/s")
unit.terminate()
unit.freeInstance()
`;
  }

  #several(): string {
    return `from fmpy import simulate_fmu, dump

dump("${this.#name()}.fmu")                # its inputs and outputs, one set for each contact
result = simulate_fmu("${this.#name()}.fmu")
print(result.dtype.names, result[-1])
`;
  }
}

export async function copy(text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    toast("Copied.");
  } catch {
    toast("The browser doesn't let this page copy: select the text instead.");
  }
}
