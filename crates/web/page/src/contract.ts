// What the exporter in the wasm is asked, and what it answers. Field names are those of its JSON.

export type Path = readonly (string | number)[];
export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type Table = { [key: string]: Json };

export interface Mistake {
  line: number;
  column: number;
  from: number;
  to: number;
  message: string;
}

/** A text of a scene that is a number with a unit, or with the scale of a hardness. */
export interface Written {
  digits: string;
  unit: string;
  /** How many SI units one `unit` is, and the number of SI units; a scale has none. */
  size?: number;
  number?: number;
}

/** What a scene can't have as it is: why, and the keys that it has against it. */
export interface Closed {
  why: string;
  by: string[];
}

export interface Check {
  values: Table | null;
  /** By their paths, as `impactor.radius`. */
  quantities: { [path: string]: Written };
  mistakes: Mistake[];
  warnings: Mistake[];
  files: string[];
  /** By key, `target.thickness`, or by key and value, `law.loading=line`. */
  closed: { [key: string]: Closed };
}

/** What somebody types in a field, with the unit or scale beside it; `bare` if the scene has a number without a unit. */
export interface Typed {
  text: string;
  unit?: string;
  bare?: boolean;
}

/** A key that gets a value, null to remove it, or what is typed for it. */
export type Edit = { path: Path; value: Json } | { path: Path; typed: Typed };

export interface Material {
  name: string;
  aliases: string[];
  source: string | null;
  density: number | null;
  youngs_modulus: number | null;
  poissons_ratio: number | null;
  yield_strength: number | null;
  /** In place of a yield strength: a flow stress `K eps^n`, or a hardness. */
  tension?: { coefficient: number; exponent: number } | null;
  hardness?: string | null;
  hardening_exponent?: number | null;
  /** What to say wherever it is used. */
  warning?: string | null;
}

export interface LawEntry {
  name: string;
  title: string;
  says: string;
  validity: string;
  recommended?: boolean;
  /** Keys of the table of laws that don't go with a loading law, and those that it needs. */
  closes?: string[];
  needs?: string[];
}

export interface About {
  version: string;
  laws: { loading: LawEntry[]; unloading: LawEntry[]; damped: LawEntry[] };
  materials: Material[];
  tools: { name: string; title: string }[];
  /** The usual units of each SI unit, with their sizes. */
  units: { [si: string]: [unit: string, size: number][] };
  platforms: { folder: string; title?: string; targets: string[] }[];
  /** In the order of their numbers. */
  regimes: { name: string; means: string }[];
  examples: { title: string; look: string; text: string }[];
}

export interface Prediction {
  law: string;
  regime: number;
  regime_name: string;
  largest_force: number;
  largest_indentation: number;
  largest_contact_radius: number;
  dent: number;
  restitution: number;
  kinetic_energy: number;
  energy_lost: number;
  loading_time: number;
  unloading_time: number;
  rebound_speed: number;
  onsets: { regime_name: string; speed: number }[];
  warnings: string[];
  /** What the uncertainty of a strength makes of the quantities, and of the regime: 95 % are within. */
  spread: Record<string, [number, number]> | null;
}

/** Of impactor and target. */
export type Both = [impactor: number, target: number];

/** What a drawing needs beside the numbers of the impact. */
export interface Shape {
  /** 0 for a flat, below 0 for a socket [m]. */
  radii: Both;
  /** Parts of the elastic compliance, and of the dent. */
  elastic: Both;
  dent: Both;
  /** Whether it is known how much of the dent each body has. */
  dent_is_known: boolean;
}

export interface Predict {
  contacts: number;
  mass: number;
  speed: number;
  drop_height: number | null;
  laws: Prediction[];
  notes: string[];
  strength: { yield_strength: number } | null;
  text: string;
  shape: Shape;
  /** Relative standard deviation of the softer body's strength, if it has one. */
  deviation: number | null;
}

/** Columns of numbers of several laws: a curve, a history or a sweep. */
export interface Columns {
  columns: { name: string; unit: string }[];
  laws: ({ law: string } & { [column: string]: number[] | string })[];
}

/** The same with each uncertain strength throughout its band. */
export interface Families {
  families: Columns[];
}

/** The bands of each speed. */
export interface SweepBands {
  speed: number[];
  bands: (Record<string, [number, number]> | null)[];
}

export interface Way {
  name: string;
  what: string;
  master: string;
  /** Whether FMU and importer fit. */
  right: boolean;
  knows_mass: boolean;
}

export interface Rebound {
  contact: number;
  time: number;
  speed_in: number;
  speed_out: number;
  /** None if the bodies came at no speed. */
  restitution: number | null;
  steps: number;
}

export interface Bounce {
  seen: {
    time: number[];
    /** Of each contact; negative where the bodies press. */
    gaps: number[][];
    rebounds: Rebound[];
    messages: string[];
  };
}

/** What an impact is compared by; null where a tool does not define it. */
export interface Outcome {
  restitution: number;
  largest_force: number | null;
  contact_time: number | null;
  depth: number | null;
}

export interface Translated {
  name: string;
  title: string;
  law: string;
  block: string;
  /** Of each speed: the mean over where in a step the bodies touch, and the least and the most. */
  promised: (Outcome & { least_restitution: number; most_restitution: number })[];
  notes: string[];
}

export interface Translate {
  translation: {
    title: string;
    reference: string;
    versions: string;
    speed: number;
    speeds: number[];
    /** What the scene's law says at these speeds. */
    wanted: Outcome[];
    ways: Translated[];
    left_out: string[];
    notes: string[];
  };
  text: string;
}

export interface Exported {
  name: string;
  guid: string;
}

/** Each method with its answer. */
export interface Methods {
  about: About;
  schema: Table;
  check: Check;
  edit: { text: string };
  predict: Predict;
  curve: Columns;
  history: Columns;
  sweep: Columns;
  bands: Families & SweepBands;
  libraries: Table;
  export: Exported;
  scene_of: { text: string };
  table: { text: string };
  picture: { svg: string };
  csv: { csv: string };
  translate: Translate;
  new: { text: string };
  ways: Way[];
  bounce: Bounce;
}

export type Method = keyof Methods;
export type Question = { [key: string]: Json | Path | Edit[] | undefined };
