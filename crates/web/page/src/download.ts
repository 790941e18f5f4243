// What can be taken away: the FMU for the platforms chosen, the scene, a Python snippet that runs it, curves.
import type { About, Edit, Path } from "./contract";
import { describe, h, save, toast } from "./dom";
import { embedded, type Engine } from "./engine";
import type { Results } from "./results";
import type { Scene } from "./scene";

/** Of the drop heights of a scene [m/s^2]. */
const GRAVITY = 9.80665;

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
  readonly #says = h("p", { class: "note", "data-test": "python.says" });
  readonly #rest = h("button", { type: "button", "data-test": "download.rest", title: "Changes the scene; Undo takes it back",
    onclick: () => (this.scene.edit(...this.#missing()), this.#python.focus()) }, "Let it bounce to rest");
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
      h("h2", {}, "Run it in Python"), this.#says, h("div", { class: "row" }, this.#rest), this.#python,
      h("div", { class: "row" }, button("python", "Download .py", () => save(`${this.#name()}.py`, this.#python.textContent ?? "", "text/x-python")),
        button("copy", "Copy", () => void copy(this.#python.textContent ?? ""))),
      h("h2", {}, "Scene and curves"),
      h("div", { class: "row" },
        button("toml", "Scene .toml", () => save(`${this.#name()}.toml`, scene.text, "application/toml")),
        button("csv", "Curve .csv", () => void this.#file("csv", "curve")),
          button("history", "History .csv", () => void this.#file("csv", "history")),
            button("svg", "Picture .svg", () => void this.#file("picture", "curve"))));
    results.onPrediction(() => {
      this.#python.textContent = this.#snippet();
      const missing = this.#missing().length > 0;
      this.#rest.hidden = !missing || !this.#canRest;
      const kept = scene.value("law", "elastic_restitution"); // waves take less and less of it, and no ball rests by them alone
      const rests = !missing && typeof kept === "number" && kept < 1;
      const what = !this.#falls ? "The ball hits and leaves." : rests ? "The ball falls and bounces until it lies still." : "The ball falls and bounces.";
      const more = this.#rest.hidden ? "" :
        " To rest, the ball needs a fresh spot for each bounce, a loss below yield (2 % of the speed, a guess) and an FMU that knows its mass: the button adds what is missing.";
      this.#says.textContent = `${what} Needs fmpy: pip install fmpy.${more}`;
    });
  }

  /** Whether the FMU moves the ball, so that the script lets it fall; a scene may make the gap a constant. */
  get #falls(): boolean {
    const parameters = this.scene.value("fmu", "parameters");
    return this.scene.value("coupling") !== undefined && (!Array.isArray(parameters) || parameters.includes("initial_gap"));
  }

  /** Whether what is missing can be added: to one contact of round bodies that yield, and whose law has no loss of its own. */
  get #canRest(): boolean {
    const { scene, about } = this;
    return ["contact", "body", "friction"].every((table) => scene.value(table) === undefined) && scene.value("impactor", "shape") !== "cylinder" &&
      !about.laws.damped.some(({ name }) => name === scene.value("law", "loading")) && Boolean(this.results.prediction?.laws[0]?.onsets.length);
  }

  /** What the scene lacks for a ball that comes to rest. */
  #missing(): Edit[] {
    const lacks = (...paths: Path[]): boolean => paths.every((path) => this.scene.value(...path) === undefined);
    const edits: Edit[] = [];
    if (this.scene.value("target", "surface") !== "fresh") edits.push({ path: ["target", "surface"], value: "fresh" });
    if (lacks(["law", "elastic_restitution"], ["target", "plate_thickness"])) edits.push({ path: ["law", "elastic_restitution"], value: 0.98 });
    const mass = this.scene.value("impact", "mass") ?? this.results.mass;
    if (lacks(["coupling"]) && mass !== undefined) edits.push({ path: ["coupling", "effective_mass"], value: mass });
    return edits;
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
    if (this.scene.value("contact") !== undefined) return this.#several();
    return `from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

description = read_model_description("${this.#name()}.fmu")
variables = {variable.name: variable.valueReference for variable in description.modelVariables}
unit = FMU2Slave(guid=description.guid, unzipDirectory=extract("${this.#name()}.fmu"),
                 modelIdentifier=description.coSimulation.modelIdentifier)
unit.instantiate()
unit.setupExperiment()
unit.enterInitializationMode()
${this.#falls ? this.#fall() : this.#hit()}
unit.terminate()
unit.freeInstance()
`;
  }

  /** An impact in two hundred steps. */
  #hit(): string {
    const { mass = 1, speed = 1, laws: [law] = [] } = this.results.prediction ?? {};
    const step = Number((((law?.loading_time ?? 1e-5) + (law?.unloading_time ?? 1e-5)) / 200).toPrecision(2));
    const force = this.scene.value("coupling") === undefined ? "force" : "mean_force";
    return `unit.exitInitializationMode()

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
print(f"largest force {largest:.4g} N, leaves with {-speed:.4g} m/s")`;
  }

  /** A fall until the ball lies still, or for a minute. A parallel importer applies each force one step later, and doesn't know its effect until then. */
  #fall(): string {
    const { mass = 1, speed = 1 } = this.results.prediction ?? {};
    const inputs = this.scene.value("coupling", "inputs");
    const has = (name: string): boolean => Array.isArray(inputs) && inputs.includes(name);
    const late = this.scene.value("coupling", "master") === "parallel";
    const height = Number(((speed * speed) / (2 * GRAVITY)).toPrecision(6));
    const inMass = has("effective_mass") ? '    unit.setReal([variables["effective_mass"]], [mass])\n' : "";
    return `unit.setReal([variables["initial_gap"]], [${height}])    # m
unit.exitInitializationMode()

mass, gravity, step = ${mass}, ${GRAVITY}, 1e-3    # kg, m/s^2, s
speed = force = time = 0.0    # m/s towards the target, N, s
while time < 60.0 and (abs(speed) > 1e-6 or force == 0.0):
    before = speed
    unit.setReal([variables["indentation_rate"]], [${late ? "speed + force / mass * step])    # that force isn't applied yet" : "speed])"}
${inMass}    ${has("external_acceleration") ? 'unit.setReal([variables["external_acceleration"]], [gravity])'
      : 'unit.setRealInputDerivatives([variables["indentation_rate"]], [1], [gravity])'}
    unit.doStep(currentCommunicationPoint=time, communicationStepSize=step)
    [force] = unit.getReal([variables["mean_force"]])    # over this step
    speed += (gravity - force / mass) * step
    time += step
    if before > ${Number((0.1 * speed).toPrecision(2))} and speed < 0.0:
        print(f"{time:.3f} s: leaves with {-speed:.3g} m/s")
print(f"{time:.3f} s: lies still, held by {force:.4g} N" if time < 60.0 else "it still moves after a minute")`;
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
