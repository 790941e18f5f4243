// Bodies and impact as a form: what people know about them, in the units that they use. What is rare is folded.
import type { Json, LawEntry, Mistake, Path } from "./contract";
import { fold, h, id } from "./dom";
import { type Alternative, anyField, choice, type Context, type Field, group, material, materialOf, oneOf, quantity, several, textField, updateOpen, withScale } from "./fields";
import { placeAt } from "./places";
import { key } from "./scene";

const SCALES = ["HBW 10/3000", "HBW 2.5/187.5", "HV10", "HV1", "HRC", "HRB", "HLD"];
/** Keys that only an elastic body has. */
const ELASTIC = ["material", "youngs_modulus", "poissons_ratio"];
const STRENGTH = ["yield_strength", "hardness", "tensile_strength", "power_law", "tensile_test"];

/** What a key begins with that a law needs. */
const STARTS: { [key: string]: Json } = { restitution: 0.7 };

type Body = "impactor" | "target";
const set = (path: Path, value: Json): { path: Path; value: Json } => ({ path, value });

/** The strength of a body by what is known of it. */
function strength(context: Context, body: Body): Field {
  const at = (name: string): Path => [body, name];
  const known = (): number => materialOf(context, at("material"))?.yield_strength ?? 300e6;
  const megapascals = (value: number): string => `${Math.round(value / 1e6)} MPa`;
  const powerLaw = ["coefficient", "exponent"].map((name) => quantity(context, [body, "power_law", name]));
  const test = ["proof_stress", "tensile_strength"].map((name) => quantity(context, [body, "tensile_test", name]));
  return oneOf(context, `${body}.strength`, "Strength", [
    { label: "as the material", keys: [] },
    { label: "yield strength", keys: [at("yield_strength")], start: () => [set(at("yield_strength"), megapascals(known()))],
      field: quantity(context, at("yield_strength")) },
    { label: "hardness", keys: [at("hardness")], start: () => [set(at("hardness"), "200 HBW 10/3000")], field: withScale(context, at("hardness"), SCALES) },
    { label: "tensile strength", keys: [at("tensile_strength")], start: () => [set(at("tensile_strength"), "500 MPa")],
      field: quantity(context, at("tensile_strength")) },
    { label: "tensile test", keys: [at("tensile_test")],
      start: () => [set(at("tensile_test"), { proof_stress: "240 MPa", tensile_strength: "480 MPa" })], field: group(context, ...test) },
    { label: "power law K εⁿ", keys: [at("power_law")], start: () => [set(at("power_law"), { coefficient: "600 MPa", exponent: 0.2 })], field: group(context, ...powerLaw) },
  ], "What you know of the strength. A hardness or a tensile strength becomes the yield strength at the strain of this impact.");
}

const moduli = (context: Context, body: Body): Field[] => {
  const of = (name: "youngs_modulus" | "poissons_ratio" | "density") => ({ empty: () => materialOf(context, [body, "material"])?.[name] ?? null });
  return [
    quantity(context, [body, "youngs_modulus"], of("youngs_modulus")),
    quantity(context, [body, "poissons_ratio"], of("poissons_ratio")),
    quantity(context, [body, "density"], of("density")),
  ];
};

function elasticity(context: Context, body: Body): Field {
  const [young, poisson] = moduli(context, body);
  const at = (name: string): Path => [body, name];
  const neither: Alternative = { label: body === "impactor" ? "rigid" : "as each contact says", keys: [] };
  const start = body === "impactor" ? "bearing steel 52100, hardened" : "mild steel";
  return oneOf(context, `${body}.body`, "Body", [
    { label: "elastic: a material", keys: [at("material")], start: () => [set(at("material"), start)], field: material(context, at("material")) },
    { label: "elastic: own moduli", keys: [at("youngs_modulus"), at("poissons_ratio")],
      start: () => [set(at("youngs_modulus"), "206 GPa"), set(at("poissons_ratio"), 0.3)], field: group(context, young!, poisson!) },
    neither,
  ], body === "impactor" ? "A rigid body doesn't deform; an elastic one does, and the softer of the two yields." : "");
}

function laws(context: Context): Field {
  const { about, scene } = context;
  const chosen = h("p", { class: "chosen", "data-test": "law.chosen" });
  const name = id();
  const loadings = about.laws.loading.toSorted((a, b) => Number(b.recommended ?? false) - Number(a.recommended ?? false));
  const radio = (law: LawEntry): HTMLLabelElement =>
    h("label", { class: "law", "data-help": law.says },
      h("input", { type: "radio", name, value: law.name, "data-test": `law.${law.name}`, onchange: () => take(law) }),
      h("span", {}, h("b", {}, law.title), law.recommended ? h("em", {}, "recommended") : null, law.recommended ? null : h("small", {}, law.validity)));
  const first = loadings.filter((law) => law.recommended).map(radio);
  const others = loadings.filter((law) => !law.recommended).map(radio);
  const damped = about.laws.damped.map(radio);
  const unloading = choice(context, ["law", "unloading"],
    [[null, "that of the law"], ...about.laws.unloading.map((law): [Json, string] => [law.name, law.title])]);
  const details = group(context, unloading, anyField(context, ["law", "passivity_guard"]));
  const damping = group(context, anyField(context, ["law", "restitution"]), anyField(context, ["law", "damping"]));
  function take(loading: LawEntry): void {
    const law = (name: string): Json | undefined => scene.value("law", name);
    // what belongs to the law before, and what doesn't go with this one
    const others = new Set(["unloading", "loading_parameters", "unloading_parameters", "passivity_guard", "damping", ...(loading.closes ?? [])]);
    const start = (loading.needs ?? []).filter((name) => name in STARTS && law(name) === undefined);
    scene.edit(
      ...[...others].filter((name) => law(name) !== undefined).map((name) => set(["law", name], null)),
      set(["law", "loading"], loading.name),
      ...start.map((name) => set(["law", name], STARTS[name]!)),
    );
  }
  const folded = fold("Other laws", "law.others", ...others, h("h3", {}, "Rate-dependent, without dents"), ...damped);
  return {
    element: h("div", {}, chosen, ...first, damping.element, details.element, folded),
    paths: [],
    mark: (path, message) => [damping, details].forEach((field) => field.mark(path, message)),
    update() {
      const now = scene.value("law", "loading") ?? loadings[0]?.name;
      const boxes = [...first, ...others, ...damped].map((label) => label.querySelector("input")!);
      const found = boxes.find(({ value }) => value === now);
      for (const box of boxes) {
        // what the table of laws has against it goes with the law before
        const closed = scene.closed(["law", "loading"], box.value);
        const stays = closed && closed.by.some((by) => !by.startsWith("law."));
        [box.checked, box.disabled, box.title] = [box === found, Boolean(stays), stays ? closed.why : ""];
      }
      const entry = [...about.laws.loading, ...about.laws.damped].find((law) => law.name === found?.value);
      const isOwn = typeof now === "object"; // rows of depth and force
      chosen.textContent = isOwn ? "Law: a curve of your own" : entry && !entry.recommended ? `Law: ${entry.title}` : "";
      chosen.hidden = !chosen.textContent;
      for (const field of [damping, details]) updateOpen(context, field);
      details.element.hidden ||= isOwn;
    },
  };
}

/** The contacts and the bodies that they share: what a list can show; the rest is in the scene's text. */
function contacts(context: Context): { element: HTMLElement; fields: () => Field[]; update(): void } {
  const { scene } = context;
  const lists = h("div", {});
  let fields: Field[] = [];
  let shape = "";
  const length = (name: string): number => ((list) => (Array.isArray(list) ? list.length : 0))(scene.value(name));
  const entry = (name: string, index: number, ...inside: (Field | null)[]): HTMLElement => {
    const one = group(context, ...inside);
    fields.push(one);
    return h("div", { class: "entry", "data-test": `${name}.${index}` }, one.element,
      h("button", { type: "button", class: "quiet", "data-test": `${name}.${index}.remove`,
        onclick: () => scene.edit(set(length(name) > 1 ? [name, index] : [name], null)) }, "Remove"));
  };
  const names = (): string[] => ["ground", ...((scene.value("body") ?? []) as { name?: string }[]).map(({ name }) => name ?? "")];
  const between = (index: number, side: number, label: string): Field =>
    choice(context, ["contact", index, "between", side], names().map((name): [Json, string] => [name, name]), { label });
  const add = (name: string, more: Json = null): void => {
    const index = length(name);
    const value = { name: `${name}_${index + 1}`, ...(more as object | null) };
    scene.edit(...Object.entries(value).map(([one, given]) => set([name, index, one], given as Json)));
  };
  return {
    element: h("div", {}, h("p", { class: "note" },
      "Without an entry, the scene has one contact. What differs from the scene goes here; normals and arms of shared bodies into the scene's text."), lists,
      h("div", { class: "row" }, h("button", { type: "button", "data-test": "contact.add",
        onclick: () => add("contact", length("body") ? { between: [names().at(-1) ?? "ground", "ground"] } : null) }, "Add a contact"),
        h("button", { type: "button", "data-test": "body.add", onclick: () => add("body", { mass: "10 g" }) }, "Add a shared body"))),
    fields: () => fields,
    update() {
      const now = [length("contact"), length("body"), names().join()].join(";");
      if (now !== shape) {
        shape = now;
        fields = [];
        const any = (name: string, index: number, ...rest: string[]): Field | null => anyField(context, [name, index, ...rest]);
        lists.replaceChildren(
          ...Array.from({ length: length("body") }, (_, index) => entry("body", index, any("body", index, "name"), any("body", index, "mass"))),
          ...Array.from({ length: length("contact") }, (_, index) =>
            entry("contact", index, any("contact", index, "name"), any("contact", index, "count"), any("contact", index, "initial_gap"),
              ...(length("body") ? [between(index, 0, "Between"), between(index, 1, "and")] : []),
              anyField(context, ["contact", index, "impactor", "radius"], { label: "Radius, if it differs" }),
              anyField(context, ["contact", index, "target", "yield_strength"], { label: "Yield strength, if it differs" }))),
        );
      }
      for (const field of fields) field.update();
    },
  };
}

export class Form {
  readonly element: HTMLElement;
  readonly #fields: Field[];
  readonly #rest: { update(): void }[];
  readonly #contacts: ReturnType<typeof contacts>;
  readonly #banner = h("div", { class: "banner", role: "alert", "data-test": "mistake", hidden: true });

  constructor(readonly context: Context, readonly show: (mistake: Mistake) => void, massOfImpact: () => string | undefined) {
    const { scene } = context;
    const any = (...path: Path): Field | null => anyField(context, path);
    const fields: Field[] = [];
    const put = (...some: (Field | null)[]): HTMLElement[] => some.flatMap((field) => (field ? (fields.push(field), field.element) : []));
    const diameter = h("p", { class: "source" });
    const impactorStrength = strength(context, "impactor");
    const law = laws(context);
    const contactList = contacts(context);
    const gravity = 9.80665;
    const speed = (): number => scene.si("impact", "speed") ?? 1;
    const height = (): number => scene.si("impact", "drop_height") ?? 0.5;
    const mass = (): Json => scene.value("impact", "mass") ?? massOfImpact() ?? "4 g";
    const round = (value: number): number => Number(value.toPrecision(3));
    const impact = oneOf(context, "impact.by", "Given by", [
      { label: "a drop height", keys: [["impact", "drop_height"]],
        start: () => [set(["impact", "drop_height"], `${round((100 * speed() ** 2) / (2 * gravity))} cm`)],
          field: quantity(context, ["impact", "drop_height"], { label: "Drop height" }) },
      { label: "a speed", keys: [["impact", "speed"]], start: () => [set(["impact", "speed"], `${round(Math.sqrt(2 * gravity * height()))} m/s`)],
        field: quantity(context, ["impact", "speed"], { label: "Speed" }) },
      { label: `nothing: ${context.schema.info(["impact"])?.absent ?? ""}`, keys: [] },
    ]);
    const friction = oneOf(context, "friction.kind", "Friction", [
      { label: "none", keys: [] },
      { label: "Coulomb", keys: [["friction"]], start: () => [set(["friction", "coefficient"], 0.1)],
        field: group(context, any("friction", "coefficient"), any("friction", "directions")) },
    ]);
    const loss = oneOf(context, "law.loss", "Loss below yield", [
      { label: "none", keys: [] },
      { label: "a restitution, or waves", keys: [["law", "elastic_restitution"]], start: () => [set(["law", "elastic_restitution"], 0.98)],
        field: quantity(context, ["law", "elastic_restitution"]) },
    ]);
    const rate = (model: string, ...names: string[]): Field =>
      group(context, choice(context, ["target", "rate", "model"], [[model, model]]), ...names.map((name) => quantity(context, ["target", "rate", name])));
    const rates = oneOf(context, "target.rate.kind", "Strain rate of the target", [
      { label: "as the strength says", keys: [] },
      { label: "Johnson and Cook", keys: [["target", "rate", "c"]],
        start: () => [set(["target", "rate"], { model: "johnson-cook", c: 0.014, reference_rate: 1 })], field: rate("johnson-cook", "c", "reference_rate") },
      { label: "Cowper and Symonds", keys: [["target", "rate", "d"]],
        start: () => [set(["target", "rate"], { model: "cowper-symonds", d: 40.4, q: 5 })], field: rate("cowper-symonds", "d", "q") },
    ]);
    const coupling = oneOf(context, "coupling.kind", "The bodies are moved by", [
      { label: "the importer", keys: [] },
      { label: "the FMU, in its own steps", keys: [["coupling"]], start: () => [set(["coupling", "effective_mass"], mass())],
        field: group(context, any("coupling", "effective_mass"), any("coupling", "master"),
          several(context, ["coupling", "inputs"], [["external_acceleration", ""], ["effective_mass", ""]])) },
    ], "With a mass, the FMU is right at any step of the importer.");
    const outputs = (context.schema.info(["fmu", "outputs", 0])?.choices ?? [])
      .filter(({ value }) => value !== "force")
      .map(({ value, description }) => [String(value), description] as const);
    /** Numbers beside a material's own. */
    const overrides = (["impactor", "target"] as const).map((body) => ({ body, fields: moduli(context, body) }));
    const own = (body: Body): (Field | null)[] => overrides.find((one) => one.body === body)?.fields ?? [];
    const section = (title: string, test: string, ...children: (HTMLElement | null)[]): HTMLElement =>
      h("section", { "data-test": test }, h("h2", {}, title), ...children);

    this.element = h("form", { class: "form", "aria-label": "Bodies and impact", onsubmit: (event: Event) => event.preventDefault() },
      this.#banner,
      section("Ball", "section.impactor", ...put(quantity(context, ["impactor", "radius"])), diameter,
        ...put(elasticity(context, "impactor"), impactorStrength),
        fold("Own numbers, hardening, rod", "impactor.more",
          ...put(...own("impactor"), any("impactor", "hardening_modulus"), any("impactor", "hardening_exponent"), any("impactor", "length"), any("impactor", "area")))),
      section("Target", "section.target", ...put(elasticity(context, "target"), strength(context, "target"), any("target", "surface")),
        fold("Own numbers, hardening, shape", "target.more",
          ...put(...own("target"), any("target", "hardening_modulus"), any("target", "hardening_exponent"),
            quantity(context, ["target", "radius"], { empty: () => "flat" }), any("target", "length"), any("target", "area")))),
      section("Impact", "section.impact", ...put(impact, quantity(context, ["impact", "mass"], { empty: () => "that of the ball" }))),
      section("Law", "section.law", ...put(law)),
      h("div", { class: "folds" },
        fold("Friction", "fold.friction", ...put(friction)),
        fold("Losses", "fold.losses", ...put(loss, quantity(context, ["target", "plate_thickness"], { empty: () => "thick" }))),
        fold("Strain rate", "fold.rate", ...put(rates)),
        fold("Coupling", "fold.coupling", ...put(coupling)),
        fold("Outputs and FMU", "fold.fmu", ...put(textField(context, ["name"]), textField(context, ["description"]), textField(context, ["author"]),
          several(context, ["fmu", "outputs"], outputs, { label: "Outputs beside force" }),
          any("fmu", "initial_gap"), any("fmu", "step_size"), any("fmu", "stop_time"), any("fmu", "names"), any("fmu", "input_derivatives"),
            any("fmu", "standalone"), any("impact", "watch"))),
        fold("Several contacts", "fold.contacts", contactList.element)),
    );
    this.#fields = fields;
    this.#contacts = contactList;
    this.#rest = [contactList, {
      update: () => {
        for (const { body, fields } of overrides) for (const field of fields.slice(0, 2)) field.element.hidden = scene.value(body, "material") === undefined;
        const radius = scene.si("impactor", "radius");
        diameter.textContent = radius ? `Diameter ${Number((2e3 * radius).toPrecision(6))} mm` : "";
        impactorStrength.element.hidden = [...ELASTIC, ...STRENGTH].every((name) => scene.value("impactor", name) === undefined);
      },
    }];
    const hint = "Numbers take any unit: 5 mm, 0.2 in, 1.5 kN/mm^2. Help for the field in use appears here.";
    const strip = h("p", { class: "help", "aria-hidden": "true", "data-test": "help" }, hint);
    let meant: HTMLElement | null = null;
    const explain = (): void => void (strip.textContent = meant?.dataset.help || hint);
    for (const kind of ["focusin", "mouseover"]) this.element.addEventListener(kind, ({ target }) => {
      meant = (target as HTMLElement).closest<HTMLElement>("[data-help]");
      explain();
    });
    this.#rest.push({ update: explain });
    this.element.append(strip);
    scene.onCheck(() => this.update());
  }

  update(): void {
    const { scene } = this.context;
    for (const field of this.#fields) updateOpen(this.context, field);
    for (const part of this.#rest) part.update();
    const mistake = scene.check.mistakes[0];
    const place = mistake && placeAt(scene.places, mistake.from);
    const at = place ? key(place.path) : "";
    const all = [...this.#fields, ...this.#contacts.fields()];
    for (const field of all) field.mark(at, mistake ? mistake.message : null);
    this.#banner.hidden = !mistake;
    const isFile = mistake?.message.startsWith('law.loading.table = "'); // which only a drop brings here
    if (mistake) this.#banner.replaceChildren(h("span", {}, mistake.message, isFile ? "; drop the file on this page" : ""),
      h("button", { type: "button", "data-test": "mistake.show", onclick: () => this.show(mistake) }, `Line ${mistake.line}`));
    this.element.classList.toggle("stale", scene.check.values === null);
    for (const { element } of all) {
      const folded = element.closest("details");
      if (folded && mistake && element.querySelector('[aria-invalid="true"]')) folded.open = true;
    }
  }
}
