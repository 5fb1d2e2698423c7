/** Figures and data as files, and the command lines that give the same. */
import type { HeatMap } from "./map";
import { plant, type State } from "./state";
import { real, type Info, type Num, type Simulated, type View } from "./types";

export function save(name: string, content: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

export async function picture(map: HeatMap): Promise<Blob> {
  const canvas = document.createElement("canvas"), source = map.picture;
  canvas.width = source.width;
  canvas.height = source.height;
  const ink = canvas.getContext("2d")!;
  ink.fillStyle = "#fff";
  ink.fillRect(0, 0, canvas.width, canvas.height);
  ink.drawImage(source, 0, 0);
  const over = map.overlay.cloneNode(true) as SVGElement, box = map.overlay.getBoundingClientRect();
  over.setAttribute("width", String(canvas.width));
  over.setAttribute("height", String(canvas.height));
  over.setAttribute("viewBox", `0 0 ${box.width} ${box.height}`);
  over.querySelectorAll("text").forEach((t) => { t.setAttribute("font-size", "11"); t.setAttribute("font-family", "sans-serif"); });
  const image = new Image();
  image.src = "data:image/svg+xml," + encodeURIComponent(new XMLSerializer().serializeToString(over));
  await image.decode();
  ink.drawImage(image, 0, 0);
  return new Promise((done) => canvas.toBlob((blob) => done(blob!), "image/png"));
}

const text = (v: Num) => (v === null ? "nan" : String(v));

export function mapCsv(info: Info, s: State, view: View, colour: string): Blob {
  const x = info.axes.find((a) => a.name === s.x)!.values, y = info.axes.find((a) => a.name === s.y)!.values;
  const rows = [`${s.x},${s.y},"${colour.replace(/"/g, '""')}",status,admissible`];
  const names = ["not_computed", "settled", "not_settled", "unstable"];
  y.forEach((vy, j) => x.forEach((vx, i) => {
    const k = j * view.nx + i;
    rows.push(`${text(vx)},${text(vy)},${view.values[k]},${names[view.states[k] & 7]},${view.states[k] & 8 ? 1 : 0}`);
  }));
  return new Blob([rows.join("\n") + "\n"], { type: "text/csv" });
}

export function responsesCsv(series: { label: string; data: Simulated }[]): Blob {
  const rows = ["setting,t,y_w,u_w,y_d,u_d"];
  for (const { label, data } of series)
    data.t.forEach((t, i) => rows.push([`"${label}"`, t, ...[data.y_w, data.u_w, data.y_d, data.u_d].map((c) => real(c[i]))].join(",")));
  return new Blob([rows.join("\n") + "\n"], { type: "text/csv" });
}

const quoted = (word: string) => (/^[\w.,=+-]+$/.test(word) ? word : `'${word.replace(/'/g, `'\\''`)}'`);

export function commands(info: Info, s: State): string {
  const p = plant(s);
  const question = [`--minimize ${quoted(s.minimize)}`, ...s.where.filter((w) => w.trim()).map((w) => `--where ${quoted(w)}`),
    ...(p ? [`--plant K=${p.K},Td=${p.Td}${p.T1 !== undefined ? `,T1=${p.T1}` : ""}`] : []),
    ...(s.includeNotSettled ? ["--include-not-settled"] : [])].join(" ");
  const at = info.axes.map((a, k) => (a.name === s.x || a.name === s.y || a.values.length < 2 ? "" : ` --at ${a.name}=${a.values[s.held[k]]}`)).join("");
  const logs = [s.logX ? "x" : "", s.logY ? "y" : "", s.logColour ? "colour" : ""].filter(Boolean).join(",");
  return `portrait query ${quoted(info.file)} ${question}\n` +
    `portrait plot map ${quoted(info.file)} --x ${s.x} --y ${s.y}${at} ${s.colour ? `--colour ${quoted(s.colour)} ` : ""}${question}${logs ? ` --log ${logs}` : ""} -o map.svg\n` +
    `portrait plot front ${quoted(info.file)} --x ${quoted(s.frontX)} --y ${quoted(s.frontY)} ${question.replace(/^--minimize (?:'(?:[^']|'\\'')*'|\S+)\s?/, "")} -o front.svg`;
}
