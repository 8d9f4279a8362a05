// Hands on what the microphone hears, mono, in pieces of about 20 ms. Runs beside the page, in the sound's own thread.
class Microphone extends AudioWorkletProcessor {
  constructor() {
    super();
    this.piece = new Float32Array(Math.round(sampleRate / 50));
    this.filled = 0;
  }
  process([input]) {
    if (!input || input.length === 0) return true;
    for (let i = 0; i < input[0].length; ++i) {
      let sum = 0;
      for (const channel of input) sum += channel[i];
      this.piece[this.filled++] = sum / input.length;
      if (this.filled < this.piece.length) continue;
      this.port.postMessage(this.piece.slice());
      this.filled = 0;
    }
    return true;
  }
}
registerProcessor('microphone', Microphone);
