// What listens to the sensors for one explorer: it puts a motion into the state that grows with every
// reading.
import { listen } from "./device.js";
import { recorder } from "./recording.js";

const PAUSE = 3000; // ms without a reading: nobody knows how it has turned, and the recording ends

/** Put a motion that is complete, or none, into the state. */
export function take(explorer, { name, also }, motion) {
  explorer.change({ [name]: motion, ...also?.(motion, explorer.s) });
}

/** The readings of one control: isOn, isAsking, start(), end(), follow(). */
export class Live {
  constructor(explorer, control) {
    this.explorer = explorer;
    this.control = control;
    this.name = control.name;
    this.isOn = false;
    this.isAsking = false; // for permission, or for the first reading
    this.stop = () => {};
  }

  async start() {
    this.made = recorder();
    take(this.explorer, this.control, null);
    this.last = null; // what we have put into the state
    this.isOn = true;
    this.isAsking = true;
    this.explorer.showControls();
    try {
      this.stop = await listen((reading) => this.hear(reading));
    } catch (error) {
      this.isOn = false;
      take(this.explorer, this.control, this.control.example?.() ?? null);
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
      take(explorer, this.control, this.made.motion(false));
    }
  }
}
