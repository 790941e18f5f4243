// Sliders to play with the impact. Each goes over a decade to both sides of the scene's value, or over the range that somebody sets.
import { h, id } from "./dom";
import { type Context, materialOf } from "./fields";
import { digits, format, inUnit, pretty } from "./units";

export interface Knob {
  element: HTMLElement;
  update(): void;
}

/** What a slider changes, with its value in SI units, or on its scale. */
interface Target {
  path: (string | number)[];
  value: number;
  unit: string;
  scale?: string;
}

/** Units that a slider writes where the scene has none. */
const SLID = ["um", "mm", "m", "MPa", "GPa", "mm/s", "m/s"];

const number = (text: string): number => Number(text.trim().replace(",", "."));

function knob({ scene, about }: Context, test: string, label: string, target: () => Target | null): Knob {
  const output = h("output", {});
  const slider = h("input", { type: "range", min: -1, max: 1, step: 0.01, "data-test": `slider.${test}`, "aria-label": label, oninput: move,
    onchange: () => (drag = null) });
  const name = h("span", {}, label);
  const end = (which: string): HTMLInputElement => h("input", { type: "text", inputmode: "decimal", autocomplete: "off", "data-test": `slider.${test}.${which}`,
    "aria-label": `${label}: slider ${which}`, onchange: take });
  const [from, to] = [end("from"), end("to")];
  const unit = h("span", {});
  const wrong = h("p", { class: "wrong", role: "alert", id: id(), "data-test": `slider.${test}.wrong` });
  let middle = 0;
  /** The range that somebody has set. */
  let range: [number, number] | null = null;
  let shown: { unit: string; size: number } = { unit: "", size: 1 };
  /** The drag under way: one step of undo. */
  let drag: symbol | null = null;

  const ends = (): [number, number] => range ?? [middle / 10, middle * 10];
  /** The unit of the ends: that in which the scene or the slider writes. */
  function unitOf(now: Target): typeof shown {
    if (now.scale !== undefined) return { unit: now.scale, size: 1 };
    const written = scene.written(...now.path);
    if (written?.size) return { unit: written.unit, size: written.size };
    const sizes = new Map((about.units[now.unit] ?? []).filter(([one]) => SLID.includes(one)));
    const unit = inUnit(now.value, now.unit, sizes).unit;
    return { unit, size: sizes.get(unit) ?? 1 };
  }
  function move(): void {
    const now = target();
    if (!now || !middle) return;
    const [low, high] = ends();
    const value = Number((low * (high / low) ** ((Number(slider.value) + 1) / 2)).toPrecision(3));
    scene.type(now.path, { text: String(Number((value / shown.size).toPrecision(3))), unit: shown.unit }, (drag ??= Symbol()));
    show(value, now);
  }
  /** Takes the ends that are typed; both empty are a decade to each side again. */
  function take(): void {
    const typed = [from, to].map(({ value }) => value.trim());
    const [low, high] = typed.map(number) as [number, number];
    const isRange = low > 0 && high > low && Number.isFinite(high);
    const isWrong = !isRange && typed.some(Boolean);
    wrong.textContent = isWrong ? "A range is from a number above 0 to a larger one." : "";
    for (const field of [from, to]) field.setAttribute("aria-invalid", String(isWrong));
    if (isWrong) return;
    range = isRange ? [low * shown.size, high * shown.size] : null;
    middle = 0;
    update();
  }
  function show(value: number, now: Target): void {
    output.textContent = now.scale === undefined ? format(value, now.unit, 3) : `${value} ${now.scale}`;
  }
  function place(value: number): void {
    const [low, high] = ends();
    slider.value = String((2 * Math.log(value / low)) / Math.log(high / low) - 1);
  }
  function update(): void {
    const now = target();
    for (const field of [slider, from, to]) field.disabled = !now;
    if (!now) return void (output.textContent = "–");
    const before = shown.unit;
    shown = unitOf(now);
    const written = scene.written(...now.path);
    if (written) output.textContent = `${written.digits} ${pretty(written.unit)}`;
    else show(now.value, now);
    name.textContent = now.path.at(-1) === "drop_height" ? "Drop height" : label;
    // a range of another quantity is none of this one
    if (before !== shown.unit) range = null;
    const away = middle ? Math.log10(now.value / middle) : Infinity;
    // not every browser focuses a slider that is dragged
    if (Math.abs(away) <= 1.001 && (drag || document.activeElement === slider)) {
      if (!drag) place(now.value);
      return;
    }
    middle = now.value;
    place(now.value);
    if ([from, to].includes(document.activeElement as HTMLInputElement) && wrong.textContent) return;
    [from.value, to.value] = ends().map((one) => digits(one / shown.size, 3)) as [string, string];
    unit.textContent = pretty(shown.unit);
  }
  const element = h("div", { class: "knob" }, h("label", {}, h("span", { class: "knob-label" }, name, output), slider),
    h("div", { class: "ends" }, from, unit, to), wrong);
  return { element, update };
}

export function knobs(context: Context): Knob[] {
  const { scene } = context;
  const at = (path: string[], unit: string): Target | null => {
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
