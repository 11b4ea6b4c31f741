/** Whether the server answers. While it does not, nothing is saved, and it is asked again and again. */

import { Observable } from "../../viz/page/assets/common/observable.js";

const EVERY = 1000; // pause between two questions [ms]

/** Events: `lost` when the server does not answer any more, `back` when it does again. */
class Connection extends Observable {
  isLost = false;

  /** A request got no answer. */
  lose() {
    if (this.isLost) return;
    this.isLost = true;
    this.tell("lost");
    setTimeout(() => this.ask(), EVERY);
  }

  /** A request was answered. */
  restore() {
    if (!this.isLost) return;
    this.isLost = false;
    this.tell("back");
  }

  /** Find out whether the server answers, for example when a stream of events has ended. */
  async ask() {
    const answer = await fetch("/api/v1/", { cache: "no-store" }).catch(() => null);
    if (answer?.ok) this.restore();
    else if (this.isLost) setTimeout(() => this.ask(), EVERY);
    else this.lose();
  }
}

export const connection = new Connection();
