// Fields of the form. Each shows one key of the scene (or a choice between keys) and edits it; labels and help come from the schema.
import type { About, Closed, Edit, Json, Material, Path } from "./contract";
import { h, id, options } from "./dom";
import { key, type Scene } from "./scene";
import { help, type Schema, words } from "./schema";
import { inUnit, pretty, type Sizes, tidy, usual } from "./units";

export interface Context {
  scene: Scene;
  schema: Schema;
  about: About;
}

export interface Field {
  element: HTMLElement;
  paths: Path[];
  update(): void;
  mark(path: string, message: string | null): void;
}

export interface Look {
  label?: string;
  help?: string;
  /** What an empty field means: a number of SI units, or words. */
  empty?: () => number | string | null;
}

/** Label, control and place for a mistake. */
function shell(context: Context, path: Path, look: Look, control: HTMLElement, labelled: HTMLElement): { element: HTMLElement; mark: Field["mark"]; explain(says: string): void } {
  const info = context.schema.info(path);
  const test = key(path);
  const wrong = h("p", { class: "wrong", id: id(), "data-test": `${test}.wrong`, role: "alert" });
  labelled.id ||= id();
  labelled.dataset.test ??= test;
  const element = h("div", { class: "field" },
    h("label", { for: labelled.id }, look.label ?? info?.label ?? words(String(path.at(-1)))), control, wrong);
  const mark: Field["mark"] = (at, message) => {
    const mine = message !== null && (at === test || at.startsWith(`${test}.`));
    wrong.textContent = mine ? message : "";
    labelled.setAttribute("aria-invalid", String(mine));
    labelled.setAttribute("aria-errormessage", wrong.id);
  };
  const explain = (says: string): void => {
    element.dataset.help = says;
    if (says) labelled.setAttribute("aria-description", says);
  };
  explain(look.help ?? (info ? help(info) : ""));
  return { element, mark, explain };
}

/** Hides a field whose keys don't go with the scene. */
export function updateOpen({ scene }: Context, field: Field): void {
  field.update();
  field.element.hidden = field.paths.length > 0 && field.paths.every((path) => scene.closed(path));
}

const focused = (element: HTMLElement): boolean => element.contains(document.activeElement);

/** What somebody types stays as typed until the field is left, unless the scene changes otherwise. */
function typing(input: HTMLInputElement, value: () => Json | undefined): { sent(): void; left(): void; show(text: string): void } {
  let state: "none" | "sent" | "read" = "none";
  let own: Json | undefined;
  return {
    sent: () => void (state = "sent"),
    left: () => void (state = "none"),
    show(text) {
      if (state === "sent") [state, own] = ["read", value()];
      if (!(state === "read" && own === value() && focused(input)) && input.value !== text) input.value = text;
    },
  };
}

/** A number with its unit. A bare number of the scene stays bare where that is exact. */
export function quantity(context: Context, path: Path, look: Look = {}): Field {
  const { scene } = context;
  const info = context.schema.info(path);
  const base = info?.unit ?? "";
  const sizes: Sizes = new Map(context.about.units[base] ?? [[base, 1]]);
  const input = h("input", { type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", oninput: send, onblur: () => (typed.left(), field.update()) });
  const units = h("select", { "aria-label": "unit", "data-test": `${key(path)}.unit`, onchange: convert },
    ...options([...sizes.keys()].map((unit) => [unit, pretty(unit)])));
  const { element, mark, explain } = shell(context, path, look, h("div", { class: "control" }, input, base ? units : null), input);
  const typed = typing(input, () => scene.value(...path));
  let wanted: string | null = null;
  if (base) setUnit(usual(base));

  function send(): void {
    typed.sent();
    if (base) wanted = units.value;
    scene.type(path, { text: input.value, unit: base ? units.value : "" });
  }
  function convert(): void {
    wanted = units.value;
    const now = scene.si(...path);
    if (now === null) return field.update();
    scene.type(path, { text: inUnit(now, base, sizes, wanted).digits, unit: wanted });
  }
  function setUnit(unit: string, size?: number): void {
    if (!sizes.has(unit)) {
      sizes.set(unit, size ?? 1);
      units.append(...options([[unit, pretty(unit)]]));
    }
    units.value = unit;
    if (info && !look.help) explain(help(info, unit, sizes.get(unit)));
  }
  const field: Field = {
    element,
    mark,
    paths: [path],
    update() {
      if (focused(input) && scene.busy) return;
      const value = scene.value(...path);
      const written = scene.written(...path);
      const shown = written ?? (typeof value === "number" ? inUnit(value, base, sizes, wanted ?? undefined) : null);
      const standard = info?.absent || (info?.default ?? "");
      const empty = look.empty ? look.empty() : typeof standard === "number" || typeof standard === "string" ? standard : null;
      const fallback = typeof empty === "number" ? inUnit(empty, base, sizes, wanted ?? undefined) : null;
      input.placeholder = fallback ? fallback.digits : String(empty ?? "");
      // a text that is no number with a unit has none
      if (base) setUnit(shown?.unit || (value === undefined && fallback?.unit) || wanted || usual(base), written?.size);
      typed.show(shown?.digits ?? (typeof value === "string" ? value : ""));
    },
  };
  return field;
}

export function textField(context: Context, path: Path, look: Look = {}): Field {
  const input = h("input", { type: "text", autocomplete: "off", oninput: () => context.scene.edit({ path, value: input.value || null }) });
  const { element, mark } = shell(context, path, look, input, input);
  const update = (): void => {
    const value = context.scene.value(...path);
    const shown = typeof value === "string" ? value : value === undefined ? "" : JSON.stringify(value);
    if (!(focused(input) && context.scene.busy) && input.value !== shown) input.value = shown;
    input.readOnly = value !== undefined && typeof value !== "string";
    input.placeholder = String(look.empty?.() ?? "");
  };
  return { element, mark, paths: [path], update };
}

/** One of several values; the first stands for a key that is absent. */
export function choice(context: Context, path: Path, choices: [value: Json, label: string][], look: Look = {}): Field {
  const select = h("select", { onchange: () => context.scene.edit({ path, value: (choices[select.selectedIndex] ?? [null])[0] }) },
    ...options(choices.map(([value, label]) => [String(value ?? ""), label])));
  const { element, mark } = shell(context, path, look, select, select);
  const update = (): void => {
    const value = context.scene.value(...path) ?? null;
    const shown = value === null ? String(choices[0]?.[0] ?? "") : typeof value === "object" ? JSON.stringify(value) : String(value);
    if (![...select.options].some((option) => option.value === shown)) {
      choices.push([value, shown]);
      select.append(...options([[shown, shown]]));
    }
    select.value = shown;
    choices.forEach(([one], at) => close(select.options[at]!, one === null ? undefined : context.scene.closed(path, one)));
  };
  return { element, mark, paths: [path], update };
}

/** Disables an option that doesn't go with the scene, and says why. */
function close(option: HTMLOptionElement, closed: Closed | undefined): void {
  option.disabled = closed !== undefined;
  option.title = closed?.why ?? "";
}

/** Several of a list, as checkboxes. */
export function several(context: Context, path: Path, names: readonly (readonly [name: string, title: string])[], look: Look = {}): Field {
  const boxes = names.map(([name, title]) => {
    const box = h("input", { type: "checkbox", value: name, "data-test": `${key(path)}.${name}`, onchange: send });
    return { box, label: h("label", { class: "check", title }, box, ` ${name}`) };
  });
  const titles = new Map(names);
  const set = h("fieldset", {}, h("legend", {}, look.label ?? words(String(path.at(-1)))), ...boxes.map(({ label }) => label));
  const wrong = h("p", { class: "wrong", role: "alert" });
  function send(): void {
    const chosen = boxes.filter(({ box }) => box.checked).map(({ box }) => box.value);
    context.scene.edit({ path, value: chosen.length ? chosen : null });
  }
  return {
    element: h("div", { class: "field wide" }, set, wrong),
    paths: [path],
    update() {
      const value = context.scene.value(...path);
      for (const { box, label } of boxes) {
        const closed = context.scene.closed(path, box.value);
        [box.checked, box.disabled] = [Array.isArray(value) && value.includes(box.value), closed !== undefined];
        label.title = closed?.why ?? titles.get(box.value) ?? "";
      }
    },
    mark(at, message) {
      wrong.textContent = at === key(path) || at.startsWith(`${key(path)}.`) ? message : "";
    },
  };
}

/** A number and a scale, such as a hardness. */
export function withScale(context: Context, path: Path, scales: string[], look: Look = {}): Field {
  const input = h("input", { type: "text", inputmode: "decimal", autocomplete: "off", oninput: send, onblur: () => (typed.left(), update()) });
  const select = h("select", { "aria-label": "scale", "data-test": `${key(path)}.scale`, onchange: send }, ...options(scales.map((scale) => [scale, scale])));
  const { element, mark } = shell(context, path, look, h("div", { class: "control" }, input, select), input);
  const { scene } = context;
  const typed = typing(input, () => scene.value(...path));
  function send(): void {
    typed.sent();
    scene.type(path, { text: input.value, unit: select.value });
  }
  const update = (): void => {
    if (focused(input) && scene.busy) return;
    const value = scene.value(...path);
    const written = scene.written(...path);
    if (written) {
      if (![...select.options].some((option) => option.value === written.unit)) select.append(...options([[written.unit, written.unit]]));
      select.value = written.unit;
    }
    typed.show(written?.digits ?? (typeof value === "string" ? value : ""));
  };
  return { element, mark, paths: [path], update };
}

export interface Alternative {
  label: string;
  /** The keys that only this choice has: it is the one chosen if one of them is there. */
  keys: Path[];
  /** The edits that begin it. */
  start?: () => Edit[];
  field?: Field;
}

/** A choice between keys of which one is given; choosing another one removes those of the others. */
export function oneOf(context: Context, test: string, label: string, alternatives: Alternative[], help = ""): Field {
  const select = h("select", { "data-test": test, id: id(), onchange: change },
    ...options(alternatives.map((alternative, index) => [String(index), alternative.label])));
  const { scene } = context;
  const fields = alternatives.flatMap(({ field }) => field ?? []);
  const keys = new Set(alternatives.flatMap((alternative) => alternative.keys.map(key)));
  /** Why none of these keys goes with the scene; what another alternative has against it goes with that. */
  const closing = (paths: Path[]): Closed | undefined => {
    const closed = paths.map((path) => scene.closed(path)).filter((one) => one && !one.by.some((by) => keys.has(by)));
    return closed.length === paths.length ? closed[0] : undefined;
  };
  const given = (path: Path): boolean => scene.value(...path) !== undefined;
  function change(): void {
    const chosen = alternatives[select.selectedIndex];
    const others = alternatives.flatMap((alternative) => (alternative === chosen ? [] : alternative.keys));
    scene.edit(...others.filter(given).map((path) => ({ path, value: null })), ...(chosen?.start?.() ?? []));
    show();
  }
  function show(): void {
    alternatives.forEach(({ field }, at) => field && (field.element.hidden = at !== select.selectedIndex));
  }
  return {
    element: h("div", { class: "oneof" }, h("div", { class: "field", "data-help": help }, h("label", { for: select.id }, label), select),
      ...fields.map(({ element }) => element)),
    paths: fields.flatMap(({ paths }) => paths),
    update() {
      const found = alternatives.findIndex(({ keys }) => keys.some(given));
      if (!scene.busy) select.selectedIndex = found >= 0 ? found : alternatives.findIndex(({ keys }) => keys.length === 0);
      alternatives.forEach((alternative, at) => close(select.options[at]!, closing(alternative.keys)));
      for (const field of fields) field.update();
      show();
    },
    mark: (path, message) => fields.forEach((field) => field.mark(path, message)),
  };
}

/** Several fields as one. */
export function group(context: Context, ...fields: (Field | null)[]): Field {
  const present = fields.filter((field) => field !== null);
  return {
    element: h("div", { class: "group" }, ...present.map(({ element }) => element)),
    paths: present.flatMap(({ paths }) => paths),
    update: () => present.forEach((field) => updateOpen(context, field)),
    mark: (path, message) => present.forEach((field) => field.mark(path, message)),
  };
}

/** The materials of the scene itself, then the built-in ones. */
export function materials({ scene, about }: Context): Material[] {
  const own = scene.value("material");
  const missing = { aliases: [], source: null, density: null, youngs_modulus: null, poissons_ratio: null, yield_strength: null };
  return [...(Array.isArray(own) ? own.map((entry) => ({ ...missing, ...(entry as unknown as Material), source: "of this scene" })) : []), ...about.materials];
}

export function materialOf(context: Context, path: Path): Material | undefined {
  const name = String(context.scene.value(...path) ?? "").toLowerCase();
  return name ? materials(context).find((material) => [material.name, ...(material.aliases ?? [])].some((one) => one.toLowerCase() === name)) : undefined;
}

/** All numbers of a material, as its entry has them. */
function numbersOf(one: Material): string {
  const { youngs_modulus: young, poissons_ratio: poisson, yield_strength: strength, tension, hardness, hardening_exponent: exponent, density } = one;
  return [
    young && `E ${tidy(young / 1e9)} GPa`,
    poisson && `ν ${tidy(poisson)}`,
    strength && `S ${tidy(strength / 1e6)} MPa`,
    tension && `flow stress ${tidy(tension.coefficient / 1e6)} MPa · ε^${tidy(tension.exponent)}`,
    hardness && `strength from ${hardness}`,
    exponent && `hardening exponent ${tidy(exponent)}`,
    !(strength || tension || hardness) && "stays elastic",
    density && `${tidy(density)} kg/m³`,
  ].filter(Boolean).join(", ");
}

/** A material by name, searched by any of its names. */
export function material(context: Context, path: Path, look: Look = {}): Field {
  const list = h("ul", { role: "listbox", id: id(), "aria-label": "materials", popover: "manual", class: "choices", tabindex: -1, "data-test": `${key(path)}.list` });
  const input = h("input", {
    type: "text", role: "combobox", "aria-autocomplete": "list", "aria-expanded": "false", "aria-controls": list.id, autocomplete: "off",
      placeholder: "name, number or grade",
    onfocus: () => (input.select(), open("")), onclick: () => open(""), oninput: () => open(input.value), onblur: () => (close(), field.update()), onkeydown: keys,
  });
  const numbers = h("p", { class: "source", "data-test": `${key(path)}.numbers` });
  const source = h("p", { class: "source", "data-test": `${key(path)}.source` });
  const warning = h("p", { class: "source", "data-test": `${key(path)}.warning` });
  const { element, mark } = shell(context, path, look, h("div", {}, input, list, numbers, source, warning), input);
  element.classList.add("wide"); // the end of a name tells hardened from annealed
  let active = -1;

  function open(search: string): void {
    const words = search.toLowerCase().split(/\s+/).filter(Boolean);
    const hits = materials(context).filter((one) =>
      words.every((word) => [one.name, ...(one.aliases ?? []), one.source ?? ""].join(" ").toLowerCase().includes(word)));
    list.replaceChildren(
      ...hits.map((one) =>
        h("li", { role: "option", id: id(), "aria-selected": "false", "data-value": one.name,
          onmousedown: (event: Event) => (event.preventDefault(), take(one.name)) },
          h("b", {}, one.name), h("small", {}, [numbersOf(one), ...(one.aliases ?? []).slice(0, 3)].join(" · "))),
      ),
    );
    active = -1;
    const box = input.getBoundingClientRect();
    const below = innerHeight - box.bottom > 260 || box.top < 260;
    Object.assign(list.style, {
      left: `${box.left}px`, width: `${Math.min(340, innerWidth - box.left - 8)}px`,
        maxHeight: `${Math.min(340, (below ? innerHeight - box.bottom : box.top) - 12)}px`,
      top: below ? `${box.bottom + 2}px` : "auto", bottom: below ? "auto" : `${innerHeight - box.top + 2}px`,
    });
    list.showPopover();
    input.setAttribute("aria-expanded", "true");
  }
  function close(): void {
    list.hidePopover();
    input.setAttribute("aria-expanded", "false");
    input.removeAttribute("aria-activedescendant");
  }
  function take(name: string): void {
    context.scene.edit({ path, value: name || null });
    input.value = name;
    close();
  }
  function keys(event: KeyboardEvent): void {
    const rows = [...list.children] as HTMLElement[];
    const shown = list.matches(":popover-open");
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      event.preventDefault();
      if (!shown) return open("");
      active = (active + (event.key === "ArrowDown" ? 1 : -1) + rows.length) % rows.length;
      rows.forEach((row, index) => row.setAttribute("aria-selected", String(index === active)));
      rows[active]?.scrollIntoView({ block: "nearest" });
      input.setAttribute("aria-activedescendant", rows[active]?.id ?? "");
    } else if (event.key === "Enter") {
      take(shown ? (rows[active]?.dataset.value ?? (input.value === "" ? "" : rows.length === 1 ? rows[0]?.dataset.value : undefined) ?? input.value) : input.value);
    } else if (event.key === "Escape") close();
  }
  const field: Field = {
    element,
    mark,
    paths: [path],
    update() {
      const value = context.scene.value(...path);
      if (!focused(input)) input.value = typeof value === "string" ? value : "";
      const found = materialOf(context, path);
      numbers.textContent = found ? numbersOf(found) : "";
      source.textContent = found?.source ? `Source: ${found.source}` : "";
      warning.textContent = found?.warning ?? "";
    },
  };
  return field;
}

/** A field for any key, by what the schema says of it; null where a form can't show it. */
export function anyField(context: Context, path: Path, look: Look = {}): Field | null {
  const info = context.schema.info(path);
  if (!info) return null;
  if (info.types.has("boolean") && info.types.size === 1) {
    const standard = info.default === true;
    return choice(context, path, [[null, standard ? "yes (default)" : "no (default)"], [!standard, standard ? "no" : "yes"]], look);
  }
  if (info.choices.length && !info.types.has("number") && !info.types.has("array")) {
    const first = info.default !== undefined && info.default !== null ? `${String(info.default)} (default)` : info.absent || "default";
    return choice(context, path, [[null, first],
      ...info.choices.filter(({ value }) => value !== info.default).map(({ value }): [Json, string] => [value, String(value)])], look);
  }
  if (info.types.has("number") || info.types.has("integer")) return quantity(context, path, look);
  return info.types.has("string") ? textField(context, path, look) : null;
}
