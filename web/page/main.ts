// SPDX-License-Identifier: MIT
// The page: starts the core, then one loop that draws what changed, at most once per picture of the
// screen.
import { load } from "polhode/core";
import core from "polhode/core.wasm";
import { Address } from "./address.js";
import { Explorer, type Change } from "./explorer.js";
import { Pacing } from "./pacing.js";
import { Pictures } from "./pictures.js";
import { CopyDialog } from "./panel/copies.js";
import { DrivenPanel } from "./panel/driven.js";
import { Gravitation } from "./panel/gravitation.js";
import { HeadlinePanel } from "./panel/headline.js";
import { Numbers } from "./panel/numbers.js";
import { Settings } from "./panel/settings.js";
import { Transport } from "./panel/transport.js";
import { PRESETS, preset } from "./presets/presets.js";
import { sameMotion, type Scene } from "./scene.js";
import type { Preset } from "./presets/starts.js";
import { theme } from "./theme.js";
import { Tour } from "./tour.js";
import { BodyView } from "./views/body.js";
import { LightView } from "./views/light.js";
import type { View } from "./views/pane.js";
import { PlaneView } from "./views/plane.js";
import { SphereView } from "./views/sphere.js";
import { slow, started } from "./views/stage.js";
import { StripView } from "./views/strip.js";

const element = <T extends HTMLElement = HTMLElement>(id: string) =>
  document.getElementById(id) as T;
const canvas = (id: string) => element<HTMLCanvasElement>(id);
const still = window.matchMedia("(prefers-reduced-motion: reduce)");

async function start(): Promise<void> {
  let restyle = () => {};
  theme(() => restyle()); // at once: loading the core takes a while
  const bytes = new Blob([core]).stream().pipeThrough(new DecompressionStream("gzip"));
  performance.mark("script");
  const loading = load(new Response(bytes));
  const renderer = started(canvas("body")); // now: later it waits for the first pictures of the page
  await loading;
  performance.mark("core");
  const explorer = new Explorer(preset("wing-nut").scene());

  const pictures = new Pictures((clock) => {
    try {
      paint(clock);
    } catch (error) {
      fatal("The picture stopped", error);
      throw error;
    }
  });
  const body: BodyView = new BodyView(
    canvas("body"),
    canvas("body-labels"),
    renderer,
    explorer,
    () => pictures.ask(body),
  );
  const sphere: SphereView = new SphereView(canvas("sphere"), explorer, () => pictures.ask(sphere));
  const plane = new PlaneView(canvas("plane"), explorer);
  const light = new LightView(canvas("light"), explorer);
  const strip: StripView = new StripView(canvas("strip"), explorer, () => pictures.ask(strip));
  const views: readonly View[] = [body, sphere, plane, light, strip];
  for (const view of views) pictures.watch(view);

  const headline = new HeadlinePanel(
    element("mode"),
    element("sentence"),
    element("clocks"),
    explorer,
  );
  const numbers = new Numbers(
    element("chart-tabs"),
    element("chart"),
    element("chart-about"),
    explorer,
  );
  const settings = new Settings(document, explorer);
  const gravitation = new Gravitation(explorer);
  const driven = new DrivenPanel(explorer);
  const transport = new Transport(explorer);
  const copies = new CopyDialog(explorer);

  const choice = element<HTMLSelectElement>("preset");
  /** What the page goes back to. */
  let beginning = explorer.scene;
  const name = ({ id = "", about = "", source = "" }: Partial<Preset>) => {
    choice.value = id;
    element("about").textContent = about;
    element("source").textContent = source;
  };
  /** A scene from elsewhere, and what the page says of it. */
  const show = (scene: Scene) => {
    explorer.play(false);
    explorer.change(scene);
    beginning = scene;
    for (const panel of [numbers, settings, gravitation, transport]) panel.forget();
    name(PRESETS.find((p) => sameMotion(p.scene(), scene)) ?? { about: "A state from a link." });
  };
  const address = new Address(explorer, show);
  const tour = new Tour(explorer, show);
  const begin = (id: string) => {
    if (tour.open) tour.end();
    show(preset(id).scene());
    explorer.play(!still.matches);
  };
  fill(choice, begin);
  const again = () => {
    if (tour.open) tour.end();
    show(beginning);
    explorer.play(!still.matches);
  };
  element("reset").addEventListener("click", again);

  const pacing = new Pacing(slow(renderer));
  let lastPicture = 0;
  let lastNumbers = 0;
  let resting = 0;
  function paint(clock: number): void {
    const level = body.there ? pacing.at(clock, explorer.playing) : pacing.first;
    clearTimeout(resting);
    if (explorer.playing) {
      // A page that was hidden goes on where it was.
      const interval = lastPicture ? clock - lastPicture : 0;
      pacing.after(interval);
      explorer.now += Math.min(0.1, interval / 1000) * explorer.scene.pace;
      pictures.ask();
    }
    else if (pacing.untilRest(level)) {
      resting = window.setTimeout(() => pictures.ask(body), pacing.untilRest(level));
    }
    lastPicture = explorer.playing ? clock : 0;
    if (body.refine(level.fineness)) pictures.mark(body);
    pictures.draw(explorer, body, level.every);
    if (!explorer.playing || clock - lastNumbers > level.numbers) {
      lastNumbers = clock;
      numbers.show();
      driven.show();
      transport.show();
    }
    const { dataset } = document.documentElement;
    if (!dataset["ready"]) {
      performance.mark(body.there ? "body" : "picture");
      if (body.there) dataset["ready"] = "true";
    }
  }

  explorer.onChange((change: Change) => {
    for (const view of views) view.changed(change, explorer);
    if (change === "motion") {
      headline.show();
      for (const { canvas } of [body, sphere, plane]) {
        const picture = canvas.id === "body" ? element("body-labels") : canvas;
        picture.setAttribute("aria-description", element("mode").textContent ?? "");
      }
      const { scene } = explorer;
      const own = scene.state !== beginning.state || scene.moments !== beginning.moments;
      if (own && choice.value) name({ about: `A state of your own, begun from ${scene.title}.` });
    }
    if (change !== "time") {
      settings.show();
      gravitation.show();
      element("refusal").textContent = explorer.refusal;
    }
    address.later();
    pictures.ask(...views);
  });
  const refit = (what: "size" | "theme") => {
    for (const view of views) view.changed(what, explorer);
    pictures.ask(...views);
  };
  restyle = () => refit("theme");
  const sizes = new ResizeObserver(() => refit("size"));
  for (const view of views) sizes.observe(view.canvas);

  const [closer, wider] = [() => strip.zoom(1 / 1.5), () => strip.zoom(1.5)];
  element("closer").addEventListener("click", closer);
  element("wider").addEventListener("click", wider);
  element("from-observer").addEventListener("click", () => body.fromObserver());
  expandable(() => refit("size"));
  const neighbour = (way: 1 | -1) => {
    const at = PRESETS.findIndex(({ id }) => id === choice.value);
    const next = at < 0 ? (way > 0 ? 0 : PRESETS.length - 1) : at + way;
    begin(PRESETS[(next + PRESETS.length) % PRESETS.length]!.id);
  };
  keyboard(explorer, transport, {
    n: () => neighbour(1),
    p: () => neighbour(-1),
    "[": () => transport.faster(0.5),
    "]": () => transport.faster(2),
    r: again,
    t: () => (tour.open ? tour.end() : tour.go(0)),
    c: () => copies.open(),
    g: () => gravitation.toggle(),
    "+": closer,
    "=": closer,
    "-": wider,
  });

  const linked = location.hash.length > 1;
  if (!linked || !address.open(location.hash)) {
    name(preset("wing-nut"));
    explorer.play(!linked && !still.matches);
  }
  pictures.ask(...views);
  // For a reader's console, the tests and the measurements.
  Object.assign(window, { explorer, sphere, plane, views: { body, sphere, plane, light, strip } });
}

function fill(choice: HTMLSelectElement, chosen: (id: string) => void): void {
  const elsewhere = new Option("A state of your own", "");
  elsewhere.hidden = true;
  choice.append(elsewhere);
  for (const group of ["Bodies", "Figures of the paper"] as const) {
    const list = document.createElement("optgroup");
    list.label = group;
    for (const { id, name, group: own } of PRESETS) {
      if (own === group) list.append(new Option(name, id));
    }
    choice.append(list);
  }
  choice.addEventListener("change", () => choice.value && chosen(choice.value));
}

/** One pane over the whole stage, and back. */
function expandable(changed: () => void): void {
  const toggle = (pane: HTMLElement, on: boolean) => {
    for (const other of document.querySelectorAll(".pane")) other.classList.remove("large");
    pane.classList.toggle("large", on);
    document.body.classList.toggle("one-pane", on);
    for (const button of document.querySelectorAll<HTMLElement>(".expand")) {
      const large = button.closest(".pane")!.classList.contains("large");
      button.setAttribute("aria-pressed", String(large));
    }
    changed();
  };
  for (const button of document.querySelectorAll<HTMLElement>(".expand")) {
    const pane = button.closest<HTMLElement>(".pane")!;
    button.addEventListener("click", () => toggle(pane, !pane.classList.contains("large")));
  }
  document.addEventListener("keydown", (event) => {
    const large = document.querySelector<HTMLElement>(".pane.large");
    if (event.key === "Escape" && large) toggle(large, false);
  });
}

function keyboard(
  explorer: Explorer,
  transport: Transport,
  others: Readonly<Record<string, () => void>>,
): void {
  const keys = element<HTMLDialogElement>("keys");
  element("keys-open").addEventListener("click", () => keys.showModal());
  for (const button of document.querySelectorAll<HTMLElement>("[data-close]")) {
    button.addEventListener("click", () => button.closest("dialog")!.close());
  }
  document.addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (target.closest("input, select, textarea, dialog")) return;
    const step = (explorer.model.turn / 60) * (event.shiftKey ? 12 : 1);
    const act: (() => void) | undefined = {
      " ": () => explorer.play(!explorer.playing),
      ArrowRight: () => (explorer.now += step),
      ArrowLeft: () => (explorer.now -= step),
      Home: () => (explorer.now = 0),
      ".": () => transport.flip(1),
      ",": () => transport.flip(-1),
      "?": () => keys.showModal(),
      ...others,
    }[event.key];
    if (!act || (event.key === " " && target.closest("button, [role=tab]"))) return;
    event.preventDefault();
    act();
  });
}

function fatal(what: string, error: unknown): void {
  const box = element("fatal");
  box.hidden = false;
  box.textContent = `${what}: ${(error as Error).message}`;
}

start().catch((error: unknown) => fatal("The explorer did not start", error));
