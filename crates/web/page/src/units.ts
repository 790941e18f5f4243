// Numbers with units, as people read them (1.274 kN). What somebody writes is read by the exporter.

const PREFIXES: { [prefix: string]: number } = { p: -12, n: -9, u: -6, m: -3, c: -2, d: -1, "": 0, k: 3, M: 6, G: 9, T: 12 };

/** The unit in which an empty field begins, by the SI unit. */
const USUAL: { [si: string]: string } = { m: "mm", kg: "g", Pa: "MPa", s: "us", "m^2": "mm^2" };

/** Shown instead of the letters that scenes use. */
export const pretty = (unit: string): string =>
  unit.replace(/\bu(?=[a-zA-Z])/g, "µ").replace(/\^?2\b/g, "²").replace(/\^?3\b/g, "³").replace(/[ .](?=[a-zA-Z])/g, "·");

export interface Quantity {
  digits: string;
  unit: string;
}

/** Units with their sizes: how many SI units each is. */
export type Sizes = Map<string, number>;

/** A number without the dust of binary fractions. */
export const tidy = (value: number): string => String(Number(value.toPrecision(12)));

/** `value` SI units in a unit: the one given, else that of the metric ones that needs the fewest zeros. */
export function inUnit(value: number, si: string, sizes: Sizes, given?: string): Quantity {
  const metric = [...sizes].filter(([of]) => of === si || /^[numkMG]?(m|g|s|Pa|N|J)(\/s)?$/.test(of));
  const fits = metric.find(([, size]) => Math.abs(value) >= size && Math.abs(value) < 1000 * size);
  const unit = given ?? fits?.[0] ?? usual(si);
  return { digits: tidy(value / (sizes.get(unit) ?? 1)), unit };
}

export const usual = (si: string): string => USUAL[si] ?? si;

export interface Scale {
  factor: number;
  unit: string;
}

/** The prefix that suits numbers up to `largest` of an SI unit. */
export function scaled(largest: number, unit: string): Scale {
  const base = { "kg.m^2": "kg m^2" }[unit] ?? unit;
  if (!/^(m|N|J|Pa|s|m\/s|kg|N\/m)$/.test(base) || !(largest > 0) || !Number.isFinite(largest)) return { factor: 1, unit: base };
  const shift = base === "kg" ? 3 : 0;
  const power = 3 * Math.floor((Math.log10(largest) + shift) / 3 + 1e-9);
  const bounded = Math.max(-12, Math.min(base === "m" || base === "s" || base === "m/s" || base === "kg" ? shift : 12, power));
  const prefix = Object.keys(PREFIXES).find((key) => PREFIXES[key] === bounded) ?? "";
  return { factor: 10 ** (bounded - shift), unit: (prefix + (base === "kg" ? "g" : base)).replace(/^kg$/, "kg") };
}

export const digits = (value: number, count = 4): string =>
  value === 0 ? "0" : Math.abs(value) >= 1e6 || Math.abs(value) < 1e-4 ? value.toExponential(count - 1) : String(Number(value.toPrecision(count)));

/** A number of SI units for people: "1.274 kN". */
export function format(value: number | null | undefined, unit: string, count = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const scale = scaled(Math.abs(value), unit);
  return `${digits(value / scale.factor, count)}${unit ? " " + pretty(scale.unit) : ""}`;
}
