// SPDX-License-Identifier: MIT
// Which pictures are drawn next: those that changed and are in sight, at most once per picture of the
// screen.
import type { Explorer } from "./explorer.js";
import type { View } from "./views/pane.js";

export class Pictures {
  private readonly views: View[] = [];
  private readonly due = new Set<View>();
  private readonly away = new Set<View>();
  private waiting = false;
  private turn = 0;
  private readonly sight = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const view = this.views.find(({ canvas }) => canvas === target)!;
      if (isIntersecting) this.away.delete(view);
      else this.away.add(view);
      if (isIntersecting && this.due.has(view)) this.ask();
    }
  });
  private readonly painted = (clock: number): void => {
    this.waiting = false;
    this.paint(clock);
  };

  constructor(private readonly paint: (clock: number) => void) {}

  watch(view: View): void {
    this.views.push(view);
    this.sight.observe(view.canvas);
  }

  /** With the picture that is being drawn, or the next. */
  mark(view: View): void {
    this.due.add(view);
  }

  /** At the next picture of the screen, these with it. */
  ask(...views: View[]): void {
    for (const view of views) this.due.add(view);
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(this.painted);
  }

  /** Draws what is due: `first` always, of the others each `every` times in turn. */
  draw(explorer: Explorer, first: View, every: number): void {
    this.turn = (this.turn + 1) % every;
    for (let k = 0; k < this.views.length; ++k) {
      const view = this.views[k]!;
      if (!this.due.has(view) || this.away.has(view) || view.canvas.clientWidth === 0) continue;
      if (view !== first && k % every !== this.turn) continue;
      this.due.delete(view);
      view.draw(explorer);
    }
  }
}
