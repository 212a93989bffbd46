// What listens to the sensors for one explorer: it puts a motion into the state that grows with every
// reading.
import { listen } from "./device.js";
import { recorder } from "./recording.js";

const PAUSE = 3000; // ms without a reading: nobody knows how it has turned, and the recording ends

/** The readings of one control: isOn, isAsking, start(allowed), end(), follow(). */
class Live {
  constructor(explorer, control, take) {
    this.take = (motion) => take(explorer, control, motion);
    this.explorer = explorer;
    this.control = control;
    this.name = control.name;
    this.isOn = false;
    this.isAsking = false; // for permission, or for the first reading
    this.stop = () => {};
  }

  /** allowed: a promise of what the reader has said to the browser's question. */
  async start(allowed) {
    this.made = recorder();
    this.take(null);
    this.last = null; // what we have put into the state
    this.isOn = true;
    this.isAsking = true;
    this.explorer.showControls();
    try {
      this.stop = await listen((reading) => this.hear(reading), allowed);
    } catch (error) {
      this.isOn = false;
      this.take(this.control.example?.() ?? null);
      throw error;
    } finally {
      this.isAsking = false;
      this.explorer.showControls();
    }
    if (!this.isOn) {
      this.stop();
    }
  }

  hear(reading) {
    this.follow();
    const latest = this.made.latest();
    if (!this.isOn || !reading || (latest !== null && reading.t - latest > PAUSE)) {
      this.end();
      return;
    }
    this.made.add(reading);
    this.last = this.made.motion(true);
    this.explorer.change({ [this.name]: this.last }, true);
    if (this.made.duration() >= this.control.seconds) {
      this.end();
    }
  }

  /** The reader has started again, or has chosen another recording: this one ends. */
  follow() {
    if (this.isOn && this.explorer.s[this.name] !== this.last) {
      this.end();
    }
  }

  end() {
    const { explorer, last } = this;
    const wasOn = this.isOn;
    this.isOn = false;
    this.stop();
    if (wasOn && last && !explorer.ended && explorer.s[this.name] === last) {
      this.take(this.made.motion(false));
    }
  }
}

/** take(explorer, control, motion) puts a motion that is complete, or none, into the state. */
export function liveOf(explorer, control, take) {
  return new Live(explorer, control, take);
}
