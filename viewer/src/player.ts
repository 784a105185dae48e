// Lets time run while something plays or a stream is followed; no frame is asked for otherwise.

import { followed } from "./live/follower.js";
import type { Model } from "./model.js";
import type { Store } from "./state.js";

export class Player {
  private before = 0;
  private isRunning = false;

  constructor(
    private readonly model: Model,
    private readonly store: Store,
  ) {
    store.subscribe((changes) => {
      if (changes.has("isPlaying") || changes.has("follows")) this.wake();
    });
    this.wake();
  }

  /** To be called when a stream has brought something new. */
  wake(): void {
    const { isPlaying, follows } = this.store.state;
    if (this.isRunning || !(isPlaying || follows)) return;
    this.isRunning = true;
    this.before = performance.now();
    requestAnimationFrame((now) => this.run(now));
  }

  private run(now: number): void {
    const elapsed = Math.max(0, (now - this.before) / 1000);
    this.before = now;
    this.isRunning = this.store.state.follows ? this.follow(elapsed) : this.play(elapsed);
    if (this.isRunning) requestAnimationFrame((next) => this.run(next));
  }

  private play(elapsed: number): boolean {
    const { state } = this.store;
    if (!state.isPlaying) return false;
    const time = state.time + elapsed * state.speed;
    if (time < this.model.end) this.store.set({ time });
    else this.store.set({ time: this.model.end, isPlaying: false, follows: this.model.isLive });
    return this.store.state.isPlaying;
  }

  /** Stands still where the stream does, until it brings something new. */
  private follow(elapsed: number): boolean {
    const { end, clips } = this.model;
    if (!clips.some((clip) => clip.hasPose)) return false;
    const latest = clips.find((clip) => clip.end === end);
    const span = latest?.spanOf(latest.instantAt(end).step);
    const time = followed(this.store.state.time, elapsed, end, span ? span.t1 - span.t0 : 0);
    const isAtEnd = time === end && this.store.state.time === end;
    this.store.set({ time });
    return !isAtEnd;
  }
}
