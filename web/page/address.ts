// SPDX-License-Identifier: MIT
// The address of the page and its state, kept as one. A link that is wrong changes nothing: the
// field below the bar holds it with the reason, to be mended.
import type { Explorer } from "./explorer.js";
import { fromLink, toLink } from "./link.js";
import type { Scene } from "./scene.js";

const EVERY = 400; // ms: browsers refuse pages that write their address too often

export class Address {
  private timer = 0;
  private written = "";
  private readonly field = document.getElementById("link-field") as HTMLTextAreaElement;
  private readonly box = document.getElementById("link-trouble")!;
  private readonly reason = document.getElementById("link-error")!;

  constructor(
    private readonly explorer: Explorer,
    private readonly shown: (scene: Scene) => void,
  ) {
    window.addEventListener("hashchange", () => {
      if (location.hash !== this.written) this.open(location.hash);
    });
    document.getElementById("link-try")!.addEventListener("click", () => {
      const text = this.field.value.trim();
      this.open(text.includes("#") ? text.slice(text.indexOf("#")) : text);
    });
    document.getElementById("link-drop")!.addEventListener("click", () => {
      this.trouble(null);
      this.write();
    });
  }

  /** Shows the scene of a link; false, with the reason on the page, where it has none. */
  open(link: string): boolean {
    try {
      const scene = fromLink(link);
      this.shown(scene);
      this.trouble(null);
      return true;
    } catch (error) {
      this.field.value = link;
      this.trouble((error as Error).message);
      return false;
    }
  }

  private trouble(reason: string | null): void {
    this.box.hidden = reason === null;
    this.reason.textContent = reason ?? "";
    this.field.setAttribute("aria-invalid", String(reason !== null));
  }

  /** Soon, and not while time runs or a bad link waits to be mended. */
  later(): void {
    if (this.timer || this.explorer.playing) return;
    this.timer = window.setTimeout(() => {
      this.timer = 0;
      this.write();
    }, EVERY);
  }

  private write(): void {
    if (!this.box.hidden || this.explorer.playing) return;
    this.written = toLink(this.explorer.scene);
    try {
      history.replaceState(null, "", this.written);
    } catch {
      // A browser that keeps pages of a disk from writing their address: the copies have the link.
    }
  }
}
