// SPDX-License-Identifier: MIT
// Names beside what is drawn in space: they keep clear of each other and of the rim.
import { Vector3, type Camera, type Matrix4, type Quaternion } from "three";
import { symbol, type Sheet } from "./pane.js";
import { TEXT } from "./palette.js";

interface Label {
  text: string;
  readonly at: Vector3;
  /** Null: a word, in the soft colour, below its place. */
  colour: string | null;
}

const WAYS: readonly (readonly [number, number])[] = [0, 1, -1].flatMap((u) =>
  [0, -1, 1].map((v) => [20 * u, 18 * v] as const),
);

export class Labels {
  private readonly all: Label[] = [];
  private count = 0;
  private readonly place = new Vector3();
  /** Where labels stand already: x, y. */
  private taken = new Float64Array(64);

  clear(): void {
    this.count = 0;
  }

  add(text: string, at: Vector3, colour: string | null, size = 1): void {
    const label = (this.all[this.count] ??= { text, at: new Vector3(), colour });
    label.text = text;
    label.at.copy(at).multiplyScalar(size);
    label.colour = colour;
    ++this.count;
  }

  write(sheet: Sheet, camera: Camera & { projectionMatrix: Matrix4 }, turn: Quaternion): void {
    const { context, colours, width, height } = sheet;
    const { place } = this;
    if (this.taken.length < 2 * this.count) this.taken = new Float64Array(4 * this.count);
    for (let i = 0; i < this.count; ++i) {
      const { text, at, colour } = this.all[i]!;
      place.copy(at).applyQuaternion(turn).project(camera);
      this.stand(i, ((place.x + 1) / 2) * width, ((1 - place.y) / 2) * height, colour ? 19 : 40);
      // Within the sheet: a narrow one would cut them.
      const x = Math.max(14, Math.min(width - 14, this.taken[2 * i]!));
      const y = Math.max(11, Math.min(height - 11, this.taken[2 * i + 1]!));
      if (colour) {
        symbol(context, text, x, y, colour, colours.paper);
        continue;
      }
      context.font = TEXT;
      context.textAlign = "center";
      context.textBaseline = "top";
      context.fillStyle = colours.soft;
      const low = Math.min(y + 8, height - 16);
      context.fillText(text, Math.max(26, Math.min(width - 26, x)), low);
    }
  }

  /** Takes the place itself, or the nearest beside it where no earlier label stands. */
  private stand(index: number, x: number, y: number, wide: number): void {
    const { taken } = this;
    let [u, v] = [x, y];
    for (const way of WAYS) {
      let free = true;
      for (let i = 0; i < index && free; ++i) {
        free =
          Math.abs(taken[2 * i]! - x - way[0]) > wide ||
          Math.abs(taken[2 * i + 1]! - y - way[1]) > 15;
      }
      if (!free) continue;
      u = x + way[0];
      v = y + way[1];
      break;
    }
    taken[2 * index] = u;
    taken[2 * index + 1] = v;
  }
}
