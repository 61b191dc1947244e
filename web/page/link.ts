// SPDX-License-Identifier: MIT
// The whole state in a link: read, written, and what is wrong with one that was cut. Numbers are
// written with all their digits, so that the link gives the same motion to the last bit.
import { Body, checkedState, type Quaternion, type Vec3 } from "polhode/core";
import { GRAVITY, OVERLAYS, SHAPES, type Direction, type Gravity, type Scene } from "./scene.js";

const VERSION = "1";
/** Stands last: a link without it was cut. */
const LAST = "all";
/** What the name of a unit is written with: it goes into the page, and into the copies. */
const UNIT = /^[A-Za-z0-9 */^.()-]{1,24}$/;

export class LinkError extends Error {}

export function toLink(scene: Scene): string {
  const parts: [string, string][] = [
    ["v", VERSION],
    ["name", scene.title],
    ["units", `${scene.time};${scene.moment}`],
    ["I", digits(scene.moments)],
    ["q", digits(scene.state.q)],
    ["g", digits(scene.state.g)],
    ["epoch", digits([scene.epoch])],
    ["t", digits([scene.now])],
    ["pace", digits([scene.pace])],
    ["sun", digits(scene.sun)],
    ["observer", digits(scene.observer)],
    ["shape", scene.shape],
    ["planes", scene.overlay],
    ["friction", scene.friction ? "on" : "off"],
  ];
  const { precession, gravity } = scene;
  if (gravity) parts.push(["orbit", digits(GRAVITY.map((key) => gravity[key]))]);
  if (precession) parts.push(["frame", digits([...precession.axis, precession.rate])]);
  parts.push(["end", LAST]);
  return "#" + parts.map(([key, value]) => `${key}=${written(value)}`).join("&");
}

/** All digits, and the sign of 0. */
const digits = (values: readonly number[]): string =>
  values.map((x) => (Object.is(x, -0) ? "-0" : String(x))).join();

/** Percent signs only where a link needs them: it is read by people, too. */
function written(text: string): string {
  return encodeURIComponent(text).replace(/%2C/g, ",").replace(/%3B/g, ";").replace(/%20/g, "+");
}

/** The scene of a link ("#..."). LinkError names the field, what stood there and what was expected. */
export function fromLink(link: string): Scene {
  const fields = new URLSearchParams(link.replace(/^#/, ""));
  if (fields.get("v") !== VERSION) {
    throw new LinkError(`v: ${got(fields.get("v"))}; expected ${VERSION}: no link of this page`);
  }
  const named = text(fields, "units").split(";");
  if (named.length !== 2 || !named.every((name) => UNIT.test(name))) {
    throw wrong(fields, "units", "names of a unit of time and one of moment, s;kg m2");
  }
  const [time, moment] = named as [string, string];
  const moments = numbers(fields, "I", 3) as unknown as Vec3;
  refused("I", () => new Body(...moments));
  const q = numbers(fields, "q", 4) as unknown as Quaternion;
  const g = numbers(fields, "g", 3) as unknown as Vec3;
  refused("q, g", () => checkedState({ q, g }));
  const frame = fields.has("frame") ? numbers(fields, "frame", 4) : null;
  const orbit = fields.has("orbit") ? numbers(fields, "orbit", GRAVITY.length) : null;
  const pace = numbers(fields, "pace", 1)[0]!;
  if (!(pace > 0)) throw wrong(fields, "pace", "a number above 0");
  const scene: Scene = {
    title: text(fields, "name"),
    time,
    moment,
    moments,
    state: { q, g },
    epoch: numbers(fields, "epoch", 1)[0]!,
    now: numbers(fields, "t", 1)[0]!,
    pace,
    sun: numbers(fields, "sun", 2) as unknown as Direction,
    observer: numbers(fields, "observer", 2) as unknown as Direction,
    shape: oneOf(fields, "shape", SHAPES),
    overlay: oneOf(fields, "planes", OVERLAYS),
    friction: oneOf(fields, "friction", ["on", "off"]) === "on",
    precession: frame && frame[3] !== 0 ? { axis: [frame[0]!, frame[1]!, frame[2]!], rate: frame[3]! } : null,
    gravity: orbit && (Object.fromEntries(GRAVITY.map((key, k) => [key, orbit[k]])) as unknown as Gravity),
  };
  if (fields.get("end") !== LAST) {
    throw new LinkError(`end: ${got(fields.get("end"))}; expected "${LAST}": the link was cut`);
  }
  return scene;
}

const got = (value: string | null): string => (value === null ? "missing" : `got "${value}"`);

function wrong(fields: URLSearchParams, key: string, expected: string): LinkError {
  return new LinkError(`${key}: ${got(fields.get(key))}; expected ${expected}`);
}

function text(fields: URLSearchParams, key: string): string {
  const value = fields.get(key);
  if (value === null) throw wrong(fields, key, "it in every link: this one was cut");
  return value;
}

function numbers(fields: URLSearchParams, key: string, count: number): number[] {
  const parts = text(fields, key).split(",");
  const values = parts.map((part) => (part.trim() === "" ? NaN : Number(part)));
  if (values.length !== count || !values.every(Number.isFinite)) {
    throw wrong(fields, key, count === 1 ? "a finite number" : `${count} finite numbers`);
  }
  return values;
}

function oneOf<T extends string>(fields: URLSearchParams, key: string, names: readonly T[]): T {
  const value = text(fields, key) as T;
  if (!names.includes(value)) throw wrong(fields, key, names.join(", "));
  return value;
}

/** The library's own sentence, with the field before it. */
function refused(key: string, attempt: () => unknown): void {
  try {
    attempt();
  } catch (error) {
    throw new LinkError(`${key}: ${(error as Error).message}`);
  }
}
