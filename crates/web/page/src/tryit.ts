// The FMU in the hands of an importer: choose its step and how it couples, and see what the ball does.
import type { Bounce, Rebound, Way } from "./contract";
import { describe, h } from "./dom";
import { Engine } from "./engine";
import type { Results } from "./results";
import type { Scene } from "./scene";
import { digits, format } from "./units";

interface Run {
  way: Way;
  colour: number;
  seen: Bounce["seen"];
}

const css = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const GRAVITY = 9.81;
/** Steps that a page takes at most. */
const MOST = 1e6;

export class TryIt {
  readonly element: HTMLElement;
  readonly #canvas = h("canvas", { "data-test": "try.canvas", role: "img", "aria-label": "height of the ball over time" });
  readonly #boxes: { way: Way; colour: number; box: HTMLInputElement }[] = [];
  readonly #ways = h("fieldset", { class: "ways" }, h("legend", {}, "How it is coupled"));
  readonly #step = h("input", { type: "range", min: -2.5, max: 2.5, step: 0.05, value: -1, "data-test": "try.step",
    "aria-label": "step of the importer", oninput: () => this.#plan() });
  readonly #stepText = h("output", { "data-test": "try.step.value" });
  readonly #table = h("div", { class: "table", tabindex: 0, "data-test": "try.table" });
  readonly #messages = h("ul", { class: "warnings", "data-test": "try.messages" });
  readonly #state = h("p", { class: "note", role: "status", "data-test": "try.state" });
  #runs: Run[] = [];
  #engines: Engine[] = [];
  #frame = 0;
  #timer = 0;
  #asked = 0;
  #listed: Promise<void> | null = null;
  /** The question whose answer is shown, or will be. */
  #shown = "";

  constructor(readonly scene: Scene, readonly results: Results, readonly module: WebAssembly.Module) {
    this.element = h("div", { class: "tryit" },
      h("p", { class: "note" }, "Here the FMU itself runs, step by step, as in your simulator. A step too long, or a force that comes late, changes the rebound."),
      h("div", { class: "row asked" }, h("label", { class: "knob" }, h("span", { class: "knob-label" }, "Step of the importer", this.#stepText), this.#step),
        h("button", { type: "button", class: "primary", "data-test": "try.run", onclick: () => void this.run() }, "Let it bounce")),
      this.#ways, this.#canvas, this.#state, this.#table, this.#messages);
    new ResizeObserver(() => this.#draw(Infinity)).observe(this.#canvas);
    results.onPrediction(() => this.#plan());
  }

  /** Called when the page shows this part. */
  async shown(): Promise<void> {
    this.#plan();
  }

  get #visible(): boolean {
    return this.element.offsetParent !== null;
  }

  get #duration(): number {
    const law = this.results.prediction?.laws[0];
    return law ? law.loading_time + law.unloading_time : 1e-5;
  }

  /** The step in seconds: the slider counts it in contact times. */
  get #seconds(): number {
    return Number((10 ** Number(this.#step.value) * this.#duration).toPrecision(2));
  }

  #plan(): void {
    const parts = this.#duration / this.#seconds;
    this.#stepText.textContent = `${format(this.#seconds, "s", 2)}: ${parts >= 1 ? `${digits(parts, 2)} steps per contact`
      : `${digits(1 / parts, 2)} contacts in a step`}`;
    clearTimeout(this.#timer);
    if (this.#visible && this.scene.right && this.#shown !== this.#question) this.#timer = window.setTimeout(() => void this.run(), 150);
  }

  /** What is computed, if that is anything. */
  get #question(): string {
    const { prediction } = this.results; // it may still be that of an earlier text
    return JSON.stringify([this.scene.text, prediction?.speed, this.#seconds, this.#boxes.filter(({ box }) => box.checked).map(({ way }) => way.name)]);
  }

  /** Says whether the rebounds are yet to come; the table has those of an earlier question until then. */
  #say(state: string, busy = false): void {
    this.#state.textContent = state;
    this.#table.setAttribute("aria-busy", String(busy));
  }

  #list(): Promise<void> {
    return (this.#listed ??= this.#ask());
  }

  async #ask(): Promise<void> {
    const { ok: ways } = await this.scene.engine.ask("ways", { text: this.scene.text });
    const exact = ways.find(({ right, knows_mass }) => right && knows_mass);
    const chosen = [ways[0], exact, ways.find(({ right }) => !right)];
    ways.forEach((way, colour) => {
      const box = h("input", { type: "checkbox", checked: chosen.includes(way), "data-test": `way.${way.name}`, onchange: () => this.#plan() });
      this.#boxes.push({ way, colour, box });
      this.#ways.append(h("label", { class: "law" }, box,
        h("span", {}, h("b", {}, h("i", { style: `--c: var(--series-${colour % 8})` }), way.name),
          way.right ? null : h("em", { class: "mistaken" }, "wrong"), h("small", {}, way.what))));
    });
  }

  async run(): Promise<void> {
    const asked = ++this.#asked;
    clearTimeout(this.#timer);
    this.#stop();
    const prediction = this.results.prediction;
    const law = prediction?.laws[0];
    this.#shown = prediction && law ? this.#question : "";
    if (!prediction || !law) return this.#say("");
    const height = prediction.speed ** 2 / (2 * GRAVITY);
    const time = Math.sqrt((2 * height) / GRAVITY) * (1 + 5 * law.restitution);
    const step = Math.max(this.#seconds, Number(((time * prediction.contacts) / MOST).toPrecision(2)));
    const { text } = this.scene;
    this.#say("Computing …", true);
    try {
      await this.#list();
      if (asked !== this.#asked) return;
      this.#shown = this.#question;
      const bounce = async (way: Way): Promise<Bounce["seen"]> => {
        const engine = new Engine(this.module); // a bounce needs an instance of its own
        this.#engines.push(engine);
        return (await engine.ask("bounce", { text, way: way.name, step, height, time, gravity: GRAVITY })).ok.seen;
      };
      const exact = this.#boxes.find(({ way }) => way.right && way.knows_mass);
      const chosen = this.#boxes.filter((one) => one.box.checked || one === exact);
      const seen = await Promise.all(chosen.map(({ way }) => bounce(way)));
      if (asked !== this.#asked) return;
      this.#stop();
      this.#say(step > this.#seconds ? `The step is ${format(step, "s", 2)}: shorter ones take a page too long.` : "");
      const runs = chosen.map(({ way, colour, box }, index) => ({ way, colour, shown: box.checked, seen: seen[index]! }));
      this.#runs = runs.filter(({ shown }) => shown);
      this.#tell(runs.find(({ way }) => way === exact?.way)?.seen.rebounds ?? []);
      this.#play();
    } catch (error) {
      if (asked !== this.#asked) return;
      this.#stop();
      this.#shown = "";
      this.#runs = [];
      this.#tell([]);
      this.#draw(0);
      this.#say(describe(error));
    }
  }

  #stop(): void {
    for (const engine of this.#engines.splice(0)) engine.end();
  }

  /** The rebounds, beside those of an FMU that knows the mass: it is exact at any step. */
  #tell(exact: Rebound[]): void {
    const rows = this.#runs.flatMap(({ way, colour, seen }) => {
      const first = seen.rebounds.slice(0, 3);
      if (first.length === 0) return [h("tr", {}, h("th", { scope: "row" }, h("i", { style: `--c: var(--series-${colour % 8})` }), way.name),
        h("td", { colspan: 7 }, "no rebound"))];
      return first.map((rebound, index) => {
        const reference = exact.filter(({ contact }) =>
          contact === rebound.contact)[seen.rebounds.slice(0, index).filter(({ contact }) => contact === rebound.contact).length];
        const off = reference?.restitution && rebound.restitution !== null ? rebound.restitution / reference.restitution - 1 : null;
        const number = (value: number | null | undefined): string => (typeof value === "number" ? digits(value) : "–");
        const cells = [String(rebound.steps), format(rebound.time, "s"), format(rebound.speed_in, "m/s"), format(rebound.speed_out, "m/s"),
          number(rebound.restitution), number(reference?.restitution), off === null ? "–" : Math.abs(off) < 1e-9 ? "0" : `${digits(100 * off, 2)} %`];
        return h("tr", { class: off !== null && Math.abs(off) > 0.01 ? "bad" : "" },
          index ? null : h("th", { scope: "row", rowspan: first.length }, h("i", { style: `--c: var(--series-${colour % 8})` }), way.name),
            ...cells.map((cell) => h("td", {}, cell)));
      });
    });
    const head = ["way", "steps", "at", "in", "out", "restitution", "exact", "off by"];
    this.#table.replaceChildren(h("table", {}, h("thead", {}, h("tr", {}, ...head.map((title) => h("th", { scope: "col" }, title)))), h("tbody", {}, ...rows)));
    this.#messages.replaceChildren(...this.#runs.flatMap(({ way, seen }) => seen.messages.map((message) => h("li", {}, `${way.name}: ${message}`))));
  }

  #play(): void {
    cancelAnimationFrame(this.#frame);
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return this.#draw(Infinity);
    const end = Math.max(...this.#runs.map(({ seen }) => seen.time.at(-1) ?? 0));
    const began = performance.now();
    const tick = (now: number): void => {
      const part = (now - began) / 5000;
      this.#draw(part < 1 ? part * end : Infinity);
      if (part < 1) this.#frame = requestAnimationFrame(tick);
    };
    this.#frame = requestAnimationFrame(tick);
  }

  /** The balls at `now`, and where they have been: their heights over time. */
  #draw(now: number): void {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    const pen = this.#canvas.getContext("2d");
    if (!pen || !width || !height) return;
    const scale = devicePixelRatio;
    if (this.#canvas.width !== Math.round(width * scale)) Object.assign(this.#canvas, { width: Math.round(width * scale), height: Math.round(height * scale) });
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.clearRect(0, 0, width, height);
    const tracks = this.#runs.flatMap((run) => run.seen.gaps.slice(0, 4).map((heights) => ({ ...run, heights })));
    const end = Math.max(...this.#runs.map(({ seen }) => seen.time.at(-1) ?? 0), 1e-9);
    const top = Math.max(...tracks.map(({ heights }) => heights[0] ?? 0), 1e-9) * 1.15;
    const [radius, floor] = [9, height - 26];
    const stage = 28 * Math.max(1, tracks.length) + 16;
    const x = (time: number): number => stage + 10 + ((width - stage - 24) * time) / end;
    const y = (metres: number): number => floor - radius - ((floor - 2 * radius - 6) * metres) / top;
    pen.fillStyle = css("--line");
    pen.fillRect(0, floor, width, 6);
    pen.fillStyle = css("--muted");
    pen.font = "11px system-ui";
    pen.fillText("0", x(0), height - 4);
    pen.textAlign = "right";
    pen.fillText(format(end, "s", 3), width - 10, height - 4);
    pen.textAlign = "left";
    tracks.forEach(({ seen, heights, colour }, track) => {
      pen.strokeStyle = pen.fillStyle = css(`--series-${colour % 8}`);
      pen.lineWidth = 1.5;
      pen.beginPath();
      let last = 0;
      for (; last < seen.time.length && seen.time[last]! <= now; last++) pen.lineTo(x(seen.time[last]!), Math.max(-50, y(heights[last]!)));
      pen.stroke();
      const at = Math.max(0, Math.min(last, heights.length) - 1);
      pen.beginPath();
      pen.arc(16 + 28 * track + radius, Math.max(radius, y(heights[at] ?? 0)), radius, 0, 2 * Math.PI);
      pen.fill();
    });
  }
}
