// What listens to the sensors for one explorer: it puts a motion into the state that grows with every
// reading.
import { listen } from "./device.js";
import { recorder } from "./recording.js";

const PAUSE = 1000; // ms without a reading: the page was hidden, and the recording ends

/** The readings of one control: isOn, isAsking, start(), end(), follow(). */
export class Live {
  constructor(explorer, { name, seconds }) {
    this.explorer = explorer;
    this.name = name;
    this.seconds = seconds;
    this.isOn = false;
    this.isAsking = false; // for permission, or for the first reading
    this.stop = () => {};
  }

  async start() {
    this.made = recorder();
    this.explorer.change({ [this.name]: null });
    this.last = null; // what we have put into the state
    this.isOn = true;
    this.isAsking = true;
    this.explorer.showControls();
    try {
      this.stop = await listen((reading) => this.hear(reading));
    } catch (error) {
      this.isOn = false;
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
    if (!this.isOn || (latest !== null && reading.t - latest > PAUSE)) {
      this.end();
      return;
    }
    this.made.add(reading);
    this.put(true);
    if (this.made.duration() >= this.seconds) {
      this.end();
    }
  }

  put(goesOn) {
    this.last = this.made.motion(goesOn);
    this.explorer.change({ [this.name]: this.last }, goesOn);
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
      this.put(false);
    }
  }
}
