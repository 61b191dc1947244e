// SPDX-License-Identifier: MIT
// A tour of six steps: a scene each, what to look at, what to try.
import type { Explorer } from "./explorer.js";
import { preset } from "./presets/presets.js";
import type { Scene } from "./scene.js";

interface Step {
  readonly title: string;
  /** HTML of our own. */
  readonly text: string;
  readonly scene: () => Scene;
  /** Panes to look at. */
  readonly look: readonly string[];
}

const STEPS: readonly Step[] = [
  {
    title: "Polhodes",
    text: "Nothing acts on this body, so its momentum <b>G</b> stands still in space. Seen <em>from</em> the body it moves: it keeps its length and its energy, so it runs where a sphere and an ellipsoid cross. These curves are the polhodes. <b>Drag the green dot</b> to another curve; the body follows.",
    scene: () => preset("figure-1").scene(),
    look: ["sphere", "body"],
  },
  {
    title: "Two modes",
    text: "Blue curves circle the axis of the <em>greatest</em> moment, b₃: the short-axis mode of most asteroids. Dashed red ones circle the axis of the <em>least</em>, b₁: the long-axis mode. Toutatis is here: it turns about its long axis in 5.37 d while that axis goes round <b>G</b> in 7.41 d.",
    scene: () => preset("toutatis").scene(),
    look: ["headline", "sphere"],
  },
  {
    title: "The separatrix",
    text: "Between the modes two great circles pass through b₂, the <em>intermediate</em> axis. A wing nut spun about it stays near one of them: it waits, runs round the sphere, and waits upside down. Triangles on the time line mark the flips. <b>Drag the dot over the black line</b>: the mode changes, not the nut.",
    scene: () => preset("wing-nut").scene(),
    look: ["sphere", "time"],
  },
  {
    title: "Andoyer's variables",
    text: "Unroll the sphere: across, the angle <i>l</i> of the momentum about b₃; upwards, its projection <i>L</i> over its length <i>G</i>. The pair is canonical, and the free motion is a pendulum: <i>l</i> circulates in the short-axis mode, librates in the shaded long-axis mode. The other variables stand still, but for <i>g</i>.",
    scene: () => preset("figure-4").scene(),
    look: ["plane"],
  },
  {
    title: "What an observer sees",
    text: "From the Earth a tumbler is a point of light. Two periods that fit into no common one beat in its light curve: Apophis' 30.56 h and 263 h. A closed form has no memory of how long it ran: <b>pull the slide</b> to a billion turns, it costs what now costs.",
    scene: () => preset("apophis").scene(),
    look: ["light", "time"],
  },
  {
    title: "Osculating or canonical",
    text: "Describe the same free body in a frame that precesses at a rate μ. The canonical <i>l</i>, <i>L</i> stay on their curve, and give the <em>inertial</em> angular velocity ω. Elements that osculate give ω − μ, the rate <em>in</em> the frame, and leave the curve: the dashed loop. Neither is wrong; confusing them is. Change μ under <em>Frame</em>.",
    scene: () => preset("figure-5").scene(),
    look: ["plane", "body"],
  },
];

export class Tour {
  private step = -1;
  /** What was shown before: it comes back at the end. */
  private before: Scene | null = null;
  private readonly card = document.getElementById("tour")!;

  constructor(
    private readonly explorer: Explorer,
    private readonly shown: (scene: Scene) => void,
  ) {
    const on = (id: string, act: () => void) =>
      document.getElementById(id)!.addEventListener("click", act);
    on("tour-open", () => (this.step < 0 ? this.go(0) : this.end()));
    on("tour-next", () => (this.step + 1 < STEPS.length ? this.go(this.step + 1) : this.end()));
    on("tour-back", () => this.go(Math.max(0, this.step - 1)));
    on("tour-end", () => this.end());
    this.card.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.end();
    });
  }

  get open(): boolean {
    return this.step >= 0;
  }

  go(index: number): void {
    const step = STEPS[index]!;
    if (this.step < 0) this.before = this.explorer.scene;
    this.step = index;
    this.shown(step.scene());
    const set = (id: string, html: string) => (document.getElementById(id)!.innerHTML = html);
    set("tour-count", `${index + 1} of ${STEPS.length}`);
    set("tour-title", step.title);
    set("tour-text", step.text);
    set("tour-next", index + 1 < STEPS.length ? "Next" : "Done");
    (document.getElementById("tour-back") as HTMLButtonElement).disabled = index === 0;
    this.card.hidden = false;
    document.body.classList.add("touring");
    document.getElementById("tour-open")!.setAttribute("aria-expanded", "true");
    this.spot(step.look);
    document.getElementById("tour-next")!.focus({ preventScroll: true });
    if (window.matchMedia("(max-width: 48em)").matches) {
      document.getElementById(`pane-${step.look[0]}`)?.scrollIntoView({ block: "start" });
    }
    if (!window.matchMedia("(prefers-reduced-motion: reduce)").matches) this.explorer.play(true);
  }

  end(): void {
    this.step = -1;
    this.card.hidden = true;
    document.body.classList.remove("touring");
    const open = document.getElementById("tour-open")!;
    open.setAttribute("aria-expanded", "false");
    open.focus({ preventScroll: true });
    this.spot([]);
    if (this.before) this.shown(this.before);
    this.before = null;
  }

  private spot(names: readonly string[]): void {
    for (const pane of document.querySelectorAll("[id^=pane-]")) {
      pane.classList.toggle("spot", names.includes(pane.id.slice("pane-".length)));
    }
  }
}
