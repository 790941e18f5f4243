// The impact in words and numbers: a sentence, a card for each quantity, and the regimes.
import type { About, Prediction } from "./contract";
import { h } from "./dom";
import { format } from "./units";

export const percent = (part: number): string => `${Number((100 * part).toPrecision(3))} %`;

/** The impact in one or two sentences. No line ends between a number and its unit. */
export const sentence = (law: Prediction): string => said(law).replace(/(\d) /g, "$1\u00a0");

function said(law: Prediction): string {
  const back = law.rebound_speed > 0 ? `It bounces back with ${percent(law.restitution)} of its speed.` : "It doesn't bounce back.";
  if (law.dent > 0) return `A dent ${format(law.dent, "m", 3)} deep and ${format(2 * law.largest_contact_radius, "m", 3)} wide remains. ${back}`;
  return `No dent remains: the contact stays elastic. ${back}`;
}

/** What the uncertainty of a strength makes of a quantity, times a factor; empty where it makes nothing. */
function range(law: Prediction, name: string, unit: string, factor = 1): string {
  const [low, high] = (law.spread?.[name] ?? [0, 0]).map((end) => end * factor) as [number, number];
  return high - low > 1e-9 * high ? `${format(low, unit, 3)} to ${format(high, unit, 3)}` : "";
}

function card(test: string, label: string, value: string, band: string, more: string): HTMLElement {
  const [number = "", ...unit] = /^\d/.test(value) ? value.split(" ") : [value];
  return h("div", { class: "card", "data-test": `card.${test}` }, h("dt", {}, label),
    h("dd", {}, h("b", {}, number), h("span", {}, unit.join(" ")),
      band ? h("small", { class: "band", "data-test": `band.${test}`, title: "95 % are within, by the uncertainty of the strength" }, band) : null,
      h("small", {}, more)));
}

const short = (regime: string): string => regime.replace(/ \(.*/, "");

export function cards(law: Prediction, { regimes }: About): HTMLElement[] {
  const time = law.loading_time + law.unloading_time;
  const reached = (law.spread?.regime ?? []).map((regime) => regimes[regime]?.name ?? "");
  return [
    card("force", "Largest force", format(law.largest_force, "N"), range(law, "largest_force", "N"),
      `at ${format(law.largest_indentation, "m", 3)} of indentation`),
    card("dent", "Dent", law.dent > 0 ? format(law.dent, "m") : "none", range(law, "dent", "m"),
      law.dent > 0 ? `${range(law, "largest_contact_radius", "m", 2) || format(2 * law.largest_contact_radius, "m", 3)} in diameter` : "no yielding"),
    card("restitution", "Restitution", String(Number(law.restitution.toPrecision(4))), range(law, "restitution", ""),
      `leaves with ${format(law.rebound_speed, "m/s", 3)}`),
    card("time", "Contact time", format(time, "s"), range(law, "contact_time", "s"),
      `${format(law.loading_time, "s", 3)} in, ${format(law.unloading_time, "s", 3)} out`),
    card("energy", "Energy lost", format(law.energy_lost, "J"), range(law, "energy_lost", "J"),
      `${percent(law.energy_lost / law.kinetic_energy)} of ${format(law.kinetic_energy, "J", 3)}`),
    card("regime", "Regime", short(law.regime_name), reached.length && reached[0] !== reached[1] ? `${reached[0]} to ${reached[1]}` : "",
      /\((.*)\)/.exec(law.regime_name)?.[1] ?? (law.onsets.length ? "" : "at any speed")),
  ];
}

/** From which speed on what happens, with the scene's own speed, and what that is in words. */
export function regimes(law: Prediction, speed: number, about: About): HTMLElement[] {
  if (law.onsets.length === 0) return [];
  const steps = [{ regime_name: "elastic", speed: 0 }, ...law.onsets];
  const first = format(law.onsets[0]?.speed, "m/s", 3);
  const reached = steps.filter((step) => step.speed <= speed).length - 1;
  return [
    h("ol", { class: "regimes", "data-test": "regimes", "aria-label": "regimes by speed" },
      ...steps.map((step, index) => h("li", { class: index === reached ? "now" : "", "aria-current": index === reached ? "true" : null },
        h("b", {}, step.regime_name), h("small", {}, index ? `from ${format(step.speed, "m/s", 3)}` : `below ${first}`)))),
    h("p", { class: "note", "data-test": "regime.means" }, means(steps[reached]?.regime_name, about)),
  ];
}

/** What the regimes of a law mean, each in a sentence or two. */
export function meanings(law: Prediction, about: About): HTMLElement[] {
  const names = ["elastic", ...law.onsets.map(({ regime_name }) => regime_name)];
  return names.flatMap((name) => [h("dt", {}, name), h("dd", {}, means(name, about))]);
}

const means = (name: string | undefined, about: About): string => about.regimes.find((regime) => regime.name === name)?.means ?? "";
