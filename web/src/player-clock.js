// Time in the motion: runs while playing, stops at the end or starts over.

const PAUSE = 0.7; // s the last pose stays, where it starts over

export class Clock {
  constructor(duration) {
    this.duration = duration;
    this.time = 0;
    this.playing = false;
    this.speed = 1;
    this.loop = false;
    this.waited = 0;
  }

  seek(t) {
    this.time = Math.min(Math.max(Number(t) || 0, 0), this.duration);
    this.waited = 0;
  }

  play() {
    if (this.time >= this.duration && !this.loop) this.time = 0;
    this.waited = 0;
    this.playing = true;
  }

  // Lets some seconds pass; true if anything has changed.
  advance(seconds) {
    if (!this.playing) return false;
    if (this.time >= this.duration) {
      this.waited += seconds;
      if (!this.loop) this.playing = false;
      else if (this.waited > PAUSE) this.seek(0);
      return true;
    }
    this.time = Math.min(this.time + seconds * this.speed, this.duration);
    return true;
  }
}
