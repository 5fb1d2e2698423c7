/** From normalised parameters to those of a real plant, and how they move when the plant does. */
import { real, type Info, type Num } from "./types";

export interface PlantNumbers { K: number; Td: number; T1?: number }

const gain = (family: string, p: PlantNumbers) => p.K * p.Td ** (family === "dipdt" ? 2 : family === "ipdt" ? 1 : 0);

/** A normalised value times this is the real one. */
export function factor(name: string, info: Info, p: PlantNumbers | null): number {
  if (!p) return 1;
  switch (name) {
    case "kappa": return 1 / gain(info.plant, p);
    case "delta": return p.Td / gain(info.plant, p);
    case "c": return p.Td ** 2;
    case "b": return info.prefilter === "full" ? p.Td : 1;
    default: return p.Td;
  }
}

const realNames: Record<string, string> = { kappa: "Kc", delta: "Kd", tau_i: "Ti", tau_d: "TD", tau_f: "Tf", tau_1: "T1", b: "b", c: "c" };
export function axisLabel(name: string, info: Info, p: PlantNumbers | null): string {
  if (p) return `${realNames[name] ?? name} [real units]`;
  return info.axes.find((a) => a.name === name)?.label ?? name;
}

/** Where a real controller goes in the normalised plane while K and Td run around their box. */
export function box(info: Info, settings: Record<string, Num>, names: [string, string], shareK: number, shareTd: number): [number, number][] | null {
  if (!(shareK > 0) && !(shareTd > 0)) return null;
  const corners: [number, number][] = [], side = 12;
  const at = (k: number, t: number) => {
    const p: PlantNumbers = { K: 1 + shareK * k, Td: 1 + shareTd * t };
    return names.map((n) => real(settings[n]) / factor(n, info, p)) as [number, number];
  };
  for (let i = 0; i < side; ++i) corners.push(at(-1 + (2 * i) / side, -1));
  for (let i = 0; i < side; ++i) corners.push(at(1, -1 + (2 * i) / side));
  for (let i = 0; i < side; ++i) corners.push(at(1 - (2 * i) / side, 1));
  for (let i = 0; i < side; ++i) corners.push(at(-1, 1 - (2 * i) / side));
  return corners;
}
