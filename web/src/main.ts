import * as api from "./api";
import { timeChart, nyquistChart, type Curve } from "./charts";
import { dashes, lines, optimumColour } from "./colours";
import { Constraints } from "./constraints";
import { FrontView } from "./front";
import { HeatMap, stateText, type MapMark } from "./map";
import { commands, mapCsv, picture, responsesCsv, save } from "./save";
import { fromHash, mostPins, plant, toHash, type State } from "./state";
import { byId, html, svg } from "./svg";
import { real, short, type Found, type Info, type Num, type Rule, type Simulated, type View } from "./types";
import { axisLabel, box, factor } from "./units";

interface Series { label: string; colour: string; dash: string; data: Simulated; star: boolean }

class Page {
  private state: State;
  private view: View | null = null;
  private simulated = new Map<number, Simulated>();
  private chosen: number | null = null;
  private rules: Rule[] = [];
  private map = new HeatMap(byId("map"));
  private frontView = new FrontView(byId("front"));
  private constraints = new Constraints(byId("constraints"), (expression) => this.quantiles(expression));

  constructor(private info: Info) {
    this.state = fromHash(location.hash, info);
    this.build();
    this.fill();
    this.refresh(performance.now());
    window.addEventListener("hashchange", () => {
      if (location.hash === toHash(this.state)) return;
      this.state = fromHash(location.hash, info);
      this.simulated.clear();
      this.constraints.forget();
      this.fill();
      this.refresh(performance.now());
    });
  }

  // ---------------------------------------------------------------- controls

  private build(): void {
    const { info } = this;
    document.title = `${info.title || info.file} - Portrait`;
    byId("title").textContent = info.title || info.file;
    byId("about").textContent = `${info.plant}, n = ${info.n}, prefilter ${info.prefilter}, ${info.settings.toLocaleString("en")} settings, ${info.file}`;
    byId("names").replaceChildren(...info.measures.map((m) => html("option", { value: m.name, label: m.long_name })), ...info.axes.map((a) => html("option", { value: a.name, label: a.long_name })));
    for (const id of ["x", "y"]) byId(id).replaceChildren(...info.axes.map((a) => html("option", { value: a.name }, a.name)));
    byId("plant-T1-label").hidden = info.plant !== "fotd";
    this.text("minimize", "minimize"); this.text("colour", "colour");
    this.text("plant-K", "K"); this.text("plant-Td", "Td"); this.text("plant-T1", "T1");
    this.text("box-K", "boxK"); this.text("box-Td", "boxTd");
    this.text("front-x", "frontX"); this.text("front-y", "frontY");
    this.flag("log-x", "logX"); this.flag("log-y", "logY"); this.flag("log-colour", "logColour");
    this.flag("show-rules", "rules");
    this.flag("include-not-settled", "includeNotSettled");
    this.axis("x"); this.axis("y");
    this.constraints.onChange = () => this.changed();
    byId("add-constraint").addEventListener("click", () => {
      const used = (n: string) => this.state.where.some((w) => w.includes(n));
      const next = ["Ms", "TV2_ud", "TV2_uw", "TV0_yw", "TV1_yd", ...info.measures.map((m) => m.name)].find((n) => info.measures.some((m) => m.name === n) && !used(n)) ?? "Ms";
      void this.quantiles(next).then((q) => {
        this.state.where.push(`${next} <= ${short(q[Math.floor(q.length / 2)], 3)}`);
        this.showConstraints();
        this.changed();
        byId("constraints").querySelector<HTMLInputElement>("li:last-child .typed")?.focus();
      });
    });
    byId("go-optimum").addEventListener("click", () => { if (this.view?.optimum) this.goTo(this.view.optimum.coordinates); });
    byId("pin-optimum").addEventListener("click", () => { if (this.view?.optimum) this.pin(this.view.optimum.number); });
    this.map.onCursor = (i, j, byKey) => this.readout(this.numberAt(i, j), i, j, byKey);
    this.map.onPick = (i, j) => this.pin(this.numberAt(i, j));
    this.frontView.onPick = (number) => void this.choose(number);
    byId("copy-link").addEventListener("click", () => void navigator.clipboard.writeText(location.href).then(() => this.say("Link copied.")));
    byId("save-picture").addEventListener("click", () => void picture(this.map).then((blob) => save("map.png", blob)));
    byId("save-map").addEventListener("click", () => { if (this.view) save("map.csv", mapCsv(info, this.state, this.view, this.state.colour || this.state.minimize)); });
    byId("save-responses").addEventListener("click", () => save("responses.csv", responsesCsv(this.series())));
  }

  private text(id: string, key: "minimize" | "colour" | "K" | "Td" | "T1" | "boxK" | "boxTd" | "frontX" | "frontY"): void {
    byId<HTMLInputElement>(id).addEventListener("input", (e) => {
      this.state[key] = (e.target as HTMLInputElement).value;
      if (key === "K" || key === "Td" || key === "T1") { this.simulated.clear(); this.constraints.forget(); }
      this.changed();
    });
  }

  private flag(id: string, key: "logX" | "logY" | "logColour" | "includeNotSettled" | "rules"): void {
    byId<HTMLInputElement>(id).addEventListener("change", (e) => { this.state[key] = (e.target as HTMLInputElement).checked; this.changed(); });
  }

  private axis(key: "x" | "y"): void {
    byId<HTMLSelectElement>(key).addEventListener("change", (e) => {
      const other = key === "x" ? "y" : "x", wanted = (e.target as HTMLSelectElement).value;
      if (this.state[other] === wanted) this.state[other] = this.state[key];
      this.state[key] = wanted;
      this.fill();
      this.changed();
    });
  }

  /** The controls as the state says. */
  private fill(): void {
    const s = this.state;
    const set = (id: string, value: string) => { byId<HTMLInputElement>(id).value = value; };
    set("minimize", s.minimize); set("colour", s.colour); set("plant-K", s.K); set("plant-Td", s.Td); set("plant-T1", s.T1);
    set("box-K", s.boxK); set("box-Td", s.boxTd); set("front-x", s.frontX); set("front-y", s.frontY); set("x", s.x); set("y", s.y);
    for (const [id, on] of [["log-x", s.logX], ["log-y", s.logY], ["log-colour", s.logColour], ["include-not-settled", s.includeNotSettled], ["show-rules", s.rules]] as const) byId<HTMLInputElement>(id).checked = on;
    this.showConstraints();
    this.showHeld();
  }

  private showConstraints(): void { this.constraints.show(this.state.where, (where) => { this.state.where = where; }); }

  private showHeld(): void {
    const { info, state } = this;
    byId("held").replaceChildren(...info.axes.map((a, k) => {
      if (a.name === state.x || a.name === state.y || a.values.length < 2) return "";
      const shown = html("output", {}), slider = html("input", { type: "range", min: 0, max: a.values.length - 1, step: 1, value: state.held[k], id: `held-${a.name}`, "aria-label": a.name });
      const say = () => {
        const p = plant(state), v = real(a.values[state.held[k]]);
        shown.textContent = `${a.name} = ${short(v)}${p ? ` (${short(v * factor(a.name, info, p))})` : ""}`;
        slider.setAttribute("aria-valuetext", shown.textContent);
      };
      slider.addEventListener("input", () => { state.held[k] = Number(slider.value); say(); this.changed(); });
      say();
      return html("label", {}, shown, slider);
    }).filter((e): e is HTMLLabelElement => e !== ""));
  }

  // ---------------------------------------------------------------- asking

  private changed(): void {
    const now = performance.now();
    clearTimeout(this.hashTimer);
    this.hashTimer = window.setTimeout(() => history.replaceState(null, "", toHash(this.state)), 120);
    this.refresh(now);
  }
  private hashTimer = 0;
  private fresh = !location.hash;
  private frontTimer = 0;

  private question(): object {
    const s = this.state;
    return { minimize: s.minimize, where: s.where.filter((w) => w.trim()), include_not_settled: s.includeNotSettled, plant: plant(s) };
  }

  private async quantiles(expression: string): Promise<number[]> {
    return (await api.quantiles({ expression, plant: plant(this.state) })).quantiles;
  }

  private refresh = api.latest(async (since: number) => {
    const s = this.state;
    try {
      const ask = () => api.view({ ...this.question(), x: s.x, y: s.y, held: s.held, colour: s.colour || s.minimize });
      let view = await ask();
      if (this.fresh && view.optimum) {  // a first look begins where the optimum lies
        s.held = [...view.optimum.coordinates];
        this.showHeld();
        view = await ask();
      }
      this.fresh = false;
      this.view = view;
      byId("error").textContent = "";
      this.draw(view);
      document.body.dataset.viewMs = (performance.now() - since).toFixed(1);
      document.body.dataset.views = String(Number(document.body.dataset.views ?? 0) + 1);
      this.answer(view);
      void this.follow();
      clearTimeout(this.frontTimer);
      this.frontTimer = window.setTimeout(() => { this.refreshFront(); this.refreshRules(); }, 120);
    } catch (error) {
      byId("error").textContent = (error as Error).message;
    }
  });

  private refreshFront = api.latest(async () => {
    const s = this.state;
    if (!s.frontX.trim() || !s.frontY.trim()) return;
    try {
      this.frontView.show(await api.front({ ...this.question(), x_expression: s.frontX, y_expression: s.frontY }), [s.frontX, s.frontY]);
      await this.markFront();
    } catch (error) { byId("error").textContent = (error as Error).message; }
  });

  private refreshRules = api.latest(async () => {
    const s = this.state, place = s.frontX.trim() && s.frontY.trim() ? { x_expression: s.frontX, y_expression: s.frontY } : {};
    let why: string | null = null;
    try {
      if (s.rules) ({ rules: this.rules, why } = await api.rules({ ...this.question(), ...place }));
      else this.rules = [];
    } catch (error) { byId("error").textContent = (error as Error).message; return; }
    this.showRules(why);
    this.marks();
    await this.markFront();
  });

  private async markFront(): Promise<void> {
    const s = this.state, expressions = [s.frontX, s.frontY];
    const marks = await Promise.all(this.series().map(async (c) => {
      const at = await api.setting({ number: c.data.number, plant: plant(s), expressions }) as Found & { values: Num[] };
      return { x: real(at.values[0]), y: real(at.values[1]), colour: c.colour, star: c.star };
    }));
    const rules = this.rules.map((r, k) => ({ x: real(r.place?.[0]), y: real(r.place?.[1]), colour: "", star: false, rule: String(k + 1) }));
    this.frontView.setMarks([...rules, ...marks]);
  }

  private async simulate(number: number): Promise<Simulated> {
    const known = this.simulated.get(number);
    if (known) return known;
    const before = performance.now(), found = await api.simulate({ number, plant: plant(this.state) });
    document.body.dataset.simulateMs = (performance.now() - before).toFixed(1);
    this.simulated.set(number, found);
    return found;
  }

  /** Responses of the optimum and of the pins, as they are now. */
  private follow = api.latest(async () => {
    const wanted = [...this.state.pins, ...(this.view?.optimum ? [this.view.optimum.number] : []), ...(this.chosen !== null ? [this.chosen] : [])];
    try { for (const number of wanted) await this.simulate(number); } catch (error) { byId("error").textContent = (error as Error).message; return; }
    this.responses();
    this.table();
    this.marks();
  });

  private series(): Series[] {
    const list: Series[] = [], best = this.view?.optimum?.number;
    const data = (n: number) => this.simulated.get(n);
    if (best !== undefined && data(best)) list.push({ label: "optimum", colour: optimumColour, dash: "", data: data(best)!, star: true });
    if (this.chosen !== null && data(this.chosen)) list.push({ label: "chosen", colour: "#d00000", dash: "4 2", data: data(this.chosen)!, star: false });
    this.state.pins.forEach((n, k) => { if (data(n)) list.push({ label: `pin ${k + 1}`, colour: lines[k % lines.length], dash: dashes[k % dashes.length], data: data(n)!, star: false }); });
    return list;
  }

  // ---------------------------------------------------------------- acting

  private numberAt(i: number, j: number): number {
    const { info, state } = this;
    return info.axes.reduce((n, a, k) => n * a.values.length + (a.name === state.x ? i : a.name === state.y ? j : state.held[k]), 0);
  }

  private pin(number: number): void {
    const since = performance.now(), pins = this.state.pins.filter((n) => n !== number);
    pins.push(number);
    this.state.pins = pins.slice(-mostPins);
    history.replaceState(null, "", toHash(this.state));
    void this.simulate(number).then(() => {
      this.responses(); this.table(); this.marks();
      document.body.dataset.clickMs = (performance.now() - since).toFixed(1);
      document.body.dataset.clicks = String(Number(document.body.dataset.clicks ?? 0) + 1);
      return this.markFront();
    }).catch((error: Error) => { byId("error").textContent = error.message; });
  }

  private goTo(coordinates: number[]): void {
    this.state.held = [...coordinates];
    this.showHeld();
    this.changed();
  }

  private async choose(number: number): Promise<void> {
    this.chosen = number;
    const found = await this.simulate(number);
    this.goTo(found.coordinates);
  }

  // ---------------------------------------------------------------- showing

  private say(text: string): void { byId("readout").textContent = text; }

  private values(name: string): Num[] { return this.info.axes.find((a) => a.name === name)!.values; }

  private unit(expression: string): string {
    const m = this.info.measures.find((one) => one.name === expression.trim());
    const unit = m ? (plant(this.state) ? m.real_unit : m.unit) : "";
    return unit ? ` [${unit}]` : "";
  }

  private draw(view: View): void {
    const s = this.state, p = plant(s), colour = s.colour || s.minimize;
    this.map.show({
      view, x: this.values(s.x), y: this.values(s.y), logX: s.logX, logY: s.logY, logColour: s.logColour,
      factorX: factor(s.x, this.info, p), factorY: factor(s.y, this.info, p), labelX: axisLabel(s.x, this.info, p),
      labelY: axisLabel(s.y, this.info, p), labelColour: colour + this.unit(colour), marks: this.mapMarks(), box: this.uncertainty(),
    });
    byId("commands").textContent = commands(this.info, s);
  }

  private marks(): void { this.map.setMarks(this.mapMarks(), this.uncertainty()); }

  private inPlane(f: Found): boolean {
    return this.info.axes.every((a, k) => a.name === this.state.x || a.name === this.state.y || f.coordinates[k] === this.state.held[k]);
  }

  private mapMarks(): MapMark[] {
    const s = this.state;
    const marks: MapMark[] = this.rules.map((r, k) => ({ x: real(r.settings[s.x]), y: real(r.settings[s.y]), text: String(k + 1), colour: "", star: false, rule: true }));
    for (const c of this.series()) if (!c.star && this.inPlane(c.data)) marks.push({ x: real(c.data.settings[s.x]), y: real(c.data.settings[s.y]), text: c.label.replace("pin ", ""), colour: c.colour, star: false });
    const best = this.view?.optimum;
    if (best && this.inPlane(best)) marks.push({ x: real(best.settings[s.x]), y: real(best.settings[s.y]), text: "", colour: "", star: true });
    return marks;
  }

  private uncertainty(): [number, number][] | null {
    const s = this.state;
    const pins = s.pins.map((n) => this.simulated.get(n)), all = [this.view?.optimum, ...pins];
    const of = all.reverse().find((f) => f && this.inPlane(f));  // the pin set last, else the optimum
    return of ? box(this.info, of.settings, [s.x, s.y], Number(s.boxK) / 100, Number(s.boxTd) / 100) : null;
  }

  private settingsText(f: Found): string {
    const p = plant(this.state), names = this.info.axes.map((a) => a.name);
    return names.map((n) => `${n} = ${short(f.settings[n])}${p ? ` (${short(real(f.settings[n]) * factor(n, this.info, p))})` : ""}`).join(", ");
  }

  private answer(view: View): void {
    const best = view.optimum, out = view.left_out, box = byId("answer");
    const count = html("p", { id: "count", "data-admissible": view.admissible }, `${view.admissible.toLocaleString("en")} of ${view.total.toLocaleString("en")} settings are admissible`);
    const left = [["unstable", out.unstable], ["not settled", out.not_settled], ["without value", out.objective_missing + out.not_computed]].filter(([, n]) => n).map(([what, n]) => `${n.toLocaleString("en")} ${what}`).join(", ");
    const lines: HTMLElement[] = [count];
    if (left) lines.push(html("p", { class: "hint" }, `left out: ${left}`));
    if (best) {
      lines.unshift(html("p", { id: "optimum", "data-number": best.number, "data-objective": String(best.objective) }, html("strong", {}, `${this.state.minimize} = ${short(best.objective)}`), html("br"), `at ${this.settingsText(best)}`));
      const where = this.state.where.filter((w) => w.trim());
      const active = view.active.map((a) => `${where[a.constraint] ?? "plant"} (without it ${short(a.objective_without)})`).join("; ");
      if (where.length) lines.push(html("p", {}, active ? `active: ${active}` : "no constraint is active"));
      if (best.controller) lines.push(html("p", {}, "parallel " + ["Kp", "Ki", "Kd"].map((k) => `${k} = ${short(best.controller!.parallel[k] as Num)}`).join(", ")));
    } else {
      const where = this.state.where.filter((w) => w.trim()), most = view.excluded.indexOf(Math.max(...view.excluded));
      lines.unshift(html("p", { id: "optimum" }, html("strong", {}, "No setting is admissible")));
      if (most >= 0 && where[most]) lines.push(html("p", {}, `"${where[most]}" excludes the most, ${view.excluded[most].toLocaleString("en")}`));
    }
    byId<HTMLButtonElement>("go-optimum").disabled = byId<HTMLButtonElement>("pin-optimum").disabled = !best;
    box.replaceChildren(...lines);
  }

  private readoutCall = api.latest(async (number: number, head: string, live: boolean) => {
    try {
      const f = await api.setting({ number, plant: plant(this.state) });
      const rows = ["IAE_w", "IAE_d", "TV0_yw", "TV1_yd", "TV2_uw", "TV2_ud", "Ms", "Mt"].filter((n) => n in f.measures);
      const values = rows.map((n) => `${n} ${short(f.measures[n], 4)}`).join(", ");
      byId("readout").setAttribute("aria-live", live ? "polite" : "off");
      byId("readout").textContent = `${this.settingsText(f)}. ${head}. ${values}`;
    } catch (error) { byId("error").textContent = (error as Error).message; }
  });

  private readout(number: number, i: number, j: number, byKey: boolean): void {
    const view = this.view;
    if (!view || i >= view.nx || j >= view.ny) return;
    const k = j * view.nx + i, colour = this.state.colour || this.state.minimize;
    this.readoutCall(number, `${colour} = ${short(view.values[k])}, ${stateText(view.states[k])}`, byKey);
  }

  private responses(): void {
    const series = this.series(), p = plant(this.state), time = p ? "time [unit of Td]" : "time [Td]";
    const curves = (of: (s: Simulated) => Num[]): Curve[] => series.map((c) => ({ x: c.data.t, y: of(c.data), colour: c.colour, dash: c.dash, wide: c.star }));
    byId("responses").replaceChildren(
      timeChart("y, setpoint step", curves((s) => s.y_w), ""), timeChart("y, disturbance", curves((s) => s.y_d), ""),
      timeChart("u, setpoint step", curves((s) => s.u_w), time), timeChart("u, disturbance", curves((s) => s.u_d), time));
    byId("nyquist").replaceChildren(nyquistChart(series.map((c) => ({ x: c.data.re, y: c.data.im, colour: c.colour, dash: c.dash, wide: c.star })), series.map((c) => ({ colour: c.colour, value: real(c.data.measures.Ms) }))));
    byId("pins").replaceChildren(...series.map((c) => {
      const sample = svg("svg", { viewBox: "0 0 26 10", "aria-hidden": "true" }, svg("line", { x1: 0, x2: 26, y1: 5, y2: 5, stroke: c.colour, "stroke-width": c.star ? 2.6 : 2, "stroke-dasharray": c.dash }));
      const item = html("li", {}, sample, c.label);
      if (!c.star) {
        const remove = html("button", { type: "button", "aria-label": `remove ${c.label}` }, "x");
        remove.addEventListener("click", () => {
          if (c.label === "chosen") this.chosen = null; else this.state.pins = this.state.pins.filter((n) => n !== c.data.number);
          history.replaceState(null, "", toHash(this.state));
          this.responses(); this.table(); this.marks(); void this.markFront();
        });
        item.append(remove);
      }
      return item;
    }));
  }

  private showRules(why: string | null): void {
    if (!this.rules.length) { byId("rules").replaceChildren(...(why ? [html("p", { class: "hint" }, why)] : [])); return; }
    const remark = (r: Rule) => r.admissible ? "admissible" : r.violated.length ? `violates ${r.violated.join(", ")}` : r.status;
    const names = this.info.axes.map((a) => a.name);
    const head = html("tr", {}, ...["", "rule", "regret", "", ...names].map((t) => html(t ? "th" : "td", t ? { scope: "col" } : {}, t)));
    const body = this.rules.map((r, k) => html("tr", {}, html("td", {}, String(k + 1)), html("th", { scope: "row" }, r.rule), html("td", {}, short(r.regret, 4)), html("td", {}, remark(r)), ...names.map((n) => html("td", {}, short(r.settings[n], 4)))));
    byId("rules").replaceChildren(html("p", { class: "hint" }, "Tuning rules, seen along the sliders' axes; regret: what is minimized, over the optimum."), html("table", {}, html("thead", {}, head), html("tbody", {}, ...body)));
  }

  private table(): void {
    const series = this.series(), p = plant(this.state);
    if (!series.length) { byId("table").replaceChildren(html("p", { class: "hint" }, "Pin settings on the map to compare them here.")); return; }
    const row = (name: string, title: string, of: (s: Simulated) => string) => html("tr", {}, html("th", { scope: "row", title }, name), ...series.map((c) => html("td", {}, of(c.data))));
    const head = html("tr", {}, html("th", { scope: "col" }, p ? "real units" : "normalised"), ...series.map((c) => html("th", { scope: "col" }, c.label)));
    const body = [row("status", "", (s) => s.status), ...this.info.axes.map((a) => row(a.name, a.long_name, (s) => short(s.settings[a.name])))];
    if (p) for (const [form, keys] of [["parallel", ["Kp", "Ki", "Kd"]], ["standard", ["Ti", "TD"]]] as const) for (const k of keys) body.push(row(k, form, (s) => short(s.controller?.[form][k] as Num)));
    for (const m of this.info.measures) body.push(row(m.name + (p ? (m.real_unit ? ` [${m.real_unit}]` : "") : m.unit ? ` [${m.unit}]` : ""), m.long_name, (s) => short(s.measures[m.name])));
    byId("table").replaceChildren(html("table", {}, html("thead", {}, head), html("tbody", {}, ...body)));
  }
}

api.info().then((info) => { new Page(info); document.body.dataset.ready = "1"; }).catch((error: Error) => { byId("error").textContent = `The server does not answer: ${error.message}`; });
