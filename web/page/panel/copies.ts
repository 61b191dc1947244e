// SPDX-License-Identifier: MIT
// The state shown, for elsewhere: a scenario file, Python, C++, and the link of this page.
import { copies } from "polhode/core";
import type { Driven } from "../driven.js";
import type { Explorer } from "../explorer.js";
import { toLink } from "../link.js";

type Kind = "link" | "toml" | "python" | "cpp";
const KINDS: readonly (readonly [Kind, string])[] = [
  ["link", "Link"],
  ["toml", "TOML"],
  ["python", "Python"],
  ["cpp", "C++"],
];

export class CopyDialog {
  private readonly dialog = document.getElementById("copies") as HTMLDialogElement;
  private readonly text = document.getElementById("copy-text") as HTMLTextAreaElement;
  private readonly said = document.getElementById("copy-said")!;
  private readonly tabs = document.getElementById("copy-tabs")!;
  private kind: Kind = "link";

  constructor(private readonly explorer: Explorer) {
    for (const [kind, name] of KINDS) {
      const tab = document.createElement("button");
      tab.type = "button";
      tab.textContent = name;
      tab.dataset["kind"] = kind;
      tab.addEventListener("click", () => this.show(kind));
      this.tabs.append(tab);
    }
    document.getElementById("copy")!.addEventListener("click", () => void this.copy());
    document.getElementById("copies-open")!.addEventListener("click", () => this.open());
  }

  open(): void {
    this.explorer.play(false);
    this.show(this.kind);
    if (!this.dialog.open) this.dialog.showModal();
  }

  private show(kind: Kind): void {
    this.kind = kind;
    this.text.value = textOf(kind, this.explorer);
    this.said.textContent = "";
    for (const tab of this.tabs.querySelectorAll("button")) {
      tab.setAttribute("aria-pressed", String(tab.dataset["kind"] === kind));
    }
  }

  private async copy(): Promise<void> {
    this.text.select();
    try {
      await navigator.clipboard.writeText(this.text.value);
      this.said.textContent = "Copied.";
    } catch {
      this.said.textContent = document.execCommand("copy")
        ? "Copied."
        : "The browser does not let pages copy: the text is selected, copy it by Ctrl C.";
    }
  }
}

export function textOf(kind: Kind, explorer: Explorer): string {
  const { scene, model, now, state } = explorer;
  if (kind === "link") return location.href.replace(/#.*$/, "") + toLink(scene);
  const { time, moment, title } = scene;
  const options = { t0: now, title, time, moment };
  const { driven } = explorer;
  const pulled = driven?.at(now);
  if (kind !== "toml" || !driven || !pulled) return copies(model.body, state, options)[kind];
  // The body with torques, which runs on from here.
  const { toml } = copies(model.body, pulled, options);
  return toml.replace("\n[time]\n", () => `${torques(driven, now, scene.gravity!.period)}\n[time]\n`);
}

const decimal = (x: number): string => (/[.e]/.test(String(x)) ? String(x) : `${x}.0`);

/** As a scenario has them, its time 0 at `now`; the semi-axis of the orbit is the unit of length. */
function torques({ problem, orbit }: Driven, now: number, period: number): string {
  const anomaly = (orbit.meanAnomaly ?? 0) + 2 * Math.PI * ((now / period) % 1);
  const elements = {
    gm: orbit.gm,
    pericentre: orbit.pericentre,
    eccentricity: orbit.eccentricity,
    inclination: orbit.inclination ?? 0,
    node: orbit.node ?? 0,
    pericentre_argument: orbit.argument ?? 0,
    mean_anomaly: anomaly,
  };
  const lines = Object.entries(elements).map(([key, value]) => `${key} = ${decimal(value)}`);
  const term = (kind: string, more: string) => ["", "[[perturbation]]", `kind = "${kind}"`, more];
  const { internalDamping: k = 0, linearDamping: d = 0 } = problem;
  const thrice = (x: number) => `[${[x, x, x].map(decimal).join(", ")}]`;
  return [
    "",
    "[orbit.planet]",
    ...lines,
    ...term("gravity-gradient", 'orbit = "planet"'),
    ...(k > 0 ? term("internal-damping", `k = ${thrice(k)}`) : []),
    ...(d > 0 ? term("damping", `coefficients = ${thrice(d)}`) : []),
    "",
  ].join("\n");
}
