// Numbers with units, as scenes write them ("0.3 mm", "7.85 g/cm3") and as people read them (1.274 kN).

const PREFIXES: { [prefix: string]: number } = { p: -12, n: -9, u: -6, m: -3, c: -2, d: -1, "": 0, k: 3, M: 6, G: 9, T: 12 };
const PREFIXED: { [symbol: string]: number } = { m: 1, g: 1e-3, s: 1, N: 1, Pa: 1, J: 1, Hz: 1, bar: 1e5 };
const PLAIN: { [symbol: string]: number } = {
  in: 0.0254, ft: 0.3048, mil: 2.54e-5, t: 1e3, lb: 0.45359237, oz: 0.028349523125, min: 60, h: 3600, kgf: 9.80665, kp: 9.80665,
  lbf: 4.4482216152605, psi: 6894.757293168, ksi: 6894757.293168, Mpsi: 6894757293.168, mph: 0.44704, rad: 1, mrad: 1e-3,
  deg: Math.PI / 180, rpm: Math.PI / 30,
};

/** The unit in which an empty field begins, by the SI unit. */
const USUAL: { [si: string]: string } = { m: "mm", kg: "g", Pa: "MPa", s: "us", "m^2": "mm^2" };

/** Shown instead of the letters that scenes use. */
export const pretty = (unit: string): string =>
  unit.replace(/\bu(?=[a-zA-Z])/g, "µ").replace(/\^?2\b/g, "²").replace(/\^?3\b/g, "³").replace(/[ .](?=[a-zA-Z])/g, "·");

function symbol(text: string): number | null {
  const plain = PLAIN[text];
  if (plain) return plain;
  for (const [prefix, power] of Object.entries(PREFIXES)) {
    const base = text.startsWith(prefix) ? PREFIXED[text.slice(prefix.length)] : undefined;
    if (base) return base * 10 ** power;
  }
  return null;
}

/** How many SI units one `unit` is; null if it is none. */
export function factor(unit: string): number | null {
  let product = 1;
  let sign = 1;
  for (const part of unit.trim().split(/(\/)|[\s.*]+/).filter(Boolean)) {
    if (part === "/") {
      sign = -1;
      continue;
    }
    const match = /^([a-zA-Z]+|1)\^?(-?\d+)?$/.exec(part);
    const size = match && (match[1] === "1" ? 1 : symbol(match[1] ?? ""));
    if (!size) return null;
    product *= size ** (sign * Number(match[2] ?? 1));
  }
  return product;
}

export interface Quantity {
  digits: string;
  unit: string;
}

/** Number and unit of a text such as "5 mm"; null if it has no number. */
export function split(text: string): Quantity | null {
  const match = /^\s*([-+]?(?:\d[\d_]*\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$/.exec(text);
  return match ? { digits: match[1] ?? "", unit: (match[2] ?? "").replace("µ", "u") } : null;
}

/** A number without the dust of binary fractions. */
export const tidy = (value: number): string => String(Number(value.toPrecision(12)));

/** `value` SI units in a unit: the one given, else that of `units` that needs the fewest zeros. */
export function inUnit(value: number, si: string, units: string[], given?: string): Quantity {
  const size = (of: string): number => Math.abs(value) / (factor(of) ?? 1);
  const metric = units.filter((of) => of === si || /^[numkMG]?(m|g|s|Pa|N|J)(\/s)?$/.test(of));
  const fits = metric.find((of) => size(of) >= 1 && size(of) < 1000);
  const unit = given ?? fits ?? (si in USUAL ? USUAL[si]! : si);
  return { digits: tidy(value / (factor(unit) ?? 1)), unit };
}

export const usual = (si: string): string => USUAL[si] ?? si;

/** The SI number of what a scene holds: a bare number or a text with a unit. */
export function si(value: unknown): number | null {
  if (typeof value === "number") return value;
  const quantity = typeof value === "string" ? split(value) : null;
  const size = quantity && (quantity.unit === "" ? 1 : factor(quantity.unit));
  return quantity && size ? Number(quantity.digits.replaceAll("_", "")) * size : null;
}

/** The number of SI units as a scene would write it bare: exact for decimal units. */
export function bare({ digits, unit }: Quantity): number | null {
  const power = Math.log10(factor(unit) ?? NaN);
  if (Math.abs(power - Math.round(power)) > 1e-9) return null;
  const [mantissa, exponent = "0"] = digits.replaceAll("_", "").toLowerCase().split("e");
  return Number(`${mantissa}e${Number(exponent) + Math.round(power)}`);
}

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
