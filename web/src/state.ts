/** Everything that a view is, kept in the address so that it can be sent. */
import type { Info } from "./types";

export interface State {
  x: string; y: string; held: number[]; colour: string; minimize: string; where: string[];
  includeNotSettled: boolean; K: string; Td: string; T1: string; boxK: string; boxTd: string;
  logX: boolean; logY: boolean; logColour: boolean; frontX: string; frontY: string; pins: number[]; rules: boolean;
}

export const mostPins = 6;

function has(info: Info, ...names: string[]): boolean {
  return names.every((name) => info.measures.some((m) => m.name === name));
}

export function usual(info: Info): State {
  const long = info.axes.filter((a) => a.values.length > 1);
  const axes = long.length >= 2 ? long : info.axes;
  const first = info.measures[0]?.name ?? axes[0].name;
  const speed = has(info, "IAE_w", "IAE_d") ? "IAE_w + IAE_d" : first;
  return {
    x: axes[0].name, y: axes[1].name, held: info.axes.map((a) => Math.floor(a.values.length / 2)), colour: "",
    minimize: speed, where: has(info, "Ms") ? ["Ms <= 2"] : [], includeNotSettled: false, K: "", Td: "", T1: "",
    boxK: "", boxTd: "", logX: false, logY: false, logColour: true, frontX: has(info, "Ms") ? "Ms" : first,
    frontY: speed, pins: [], rules: true,
  };
}

export function toHash(s: State): string {
  const p = new URLSearchParams();
  p.set("x", s.x); p.set("y", s.y); p.set("at", s.held.join(".")); p.set("min", s.minimize);
  if (s.colour) p.set("colour", s.colour);
  for (const w of s.where) p.append("where", w);
  for (const [key, value] of [["K", s.K], ["Td", s.Td], ["T1", s.T1], ["boxK", s.boxK], ["boxTd", s.boxTd]])
    if (value) p.set(key, value);
  p.set("log", `${s.logX ? "x" : ""}${s.logY ? "y" : ""}${s.logColour ? "c" : ""}`);
  if (s.includeNotSettled) p.set("all", "1");
  if (!s.rules) p.set("rules", "0");
  p.set("fx", s.frontX); p.set("fy", s.frontY);
  if (s.pins.length) p.set("pins", s.pins.join("."));
  return "#" + p.toString();
}

const whole = (text: string): number[] => text.split(".").filter((t) => t !== "").map(Number).filter((n) => Number.isInteger(n) && n >= 0);

/** What fits the portrait is taken; what does not is left as usual. */
export function fromHash(hash: string, info: Info): State {
  const s = usual(info);
  const p = new URLSearchParams(hash.replace(/^#/, ""));
  if (!p.has("x")) return s;
  const axis = (key: string) => info.axes.find((a) => a.name === p.get(key))?.name;
  const x = axis("x"), y = axis("y");
  if (x && y && x !== y) { s.x = x; s.y = y; }
  const held = whole(p.get("at") ?? "");
  if (held.length === info.axes.length && held.every((h, k) => h < info.axes[k].values.length)) s.held = held;
  s.minimize = p.get("min") ?? s.minimize;
  s.colour = p.get("colour") ?? "";
  s.where = p.getAll("where");
  s.K = p.get("K") ?? ""; s.Td = p.get("Td") ?? ""; s.T1 = p.get("T1") ?? "";
  s.boxK = p.get("boxK") ?? ""; s.boxTd = p.get("boxTd") ?? "";
  const log = p.get("log") ?? "";
  s.logX = log.includes("x"); s.logY = log.includes("y"); s.logColour = log.includes("c");
  s.includeNotSettled = p.get("all") === "1";
  s.rules = p.get("rules") !== "0";
  s.frontX = p.get("fx") ?? s.frontX; s.frontY = p.get("fy") ?? s.frontY;
  s.pins = whole(p.get("pins") ?? "").filter((n) => n < info.settings).slice(0, mostPins);
  return s;
}

export function plant(s: State): { K: number; Td: number; T1?: number } | null {
  const Td = Number(s.Td);
  if (!s.Td.trim() || !Number.isFinite(Td)) return null;
  const T1 = s.T1.trim() ? { T1: Number(s.T1) } : {};
  return { K: s.K.trim() ? Number(s.K) : 1, Td, ...T1 };
}
