// WAV files of one channel, 8 or 16 bits.
const header = 44;

export function wav(samples: ArrayLike<number>, rate: number, bits: 8 | 16): Uint8Array {
  const bytes = bits / 8;
  const view = new DataView(new ArrayBuffer(header + samples.length * bytes));
  const word = (at: number, text: string) => [...text].forEach((c, i) => view.setUint8(at + i, c.charCodeAt(0)));
  word(0, 'RIFF');
  view.setUint32(4, header - 8 + samples.length * bytes, true);
  word(8, 'WAVEfmt ');
  view.setUint32(16, 16, true);
  view.setUint16(20, 1, true);
  view.setUint16(22, 1, true);
  view.setUint32(24, rate, true);
  view.setUint32(28, rate * bytes, true);
  view.setUint16(32, bytes, true);
  view.setUint16(34, bits, true);
  word(36, 'data');
  view.setUint32(40, samples.length * bytes, true);
  for (let i = 0; i < samples.length; ++i) {
    const value = Math.min(1, Math.max(-1, samples[i]));
    if (bits === 16) view.setInt16(header + 2 * i, Math.round(value * 32767), true);
    else view.setUint8(header + i, Math.round(128 + value * 127));
  }
  return new Uint8Array(view.buffer);
}
