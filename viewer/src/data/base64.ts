// Base64 to bytes. Browsers that have a decoder of their own take tens of milliseconds for what
// takes the loop a second.

interface NativeBase64 {
  fromBase64?: (text: string) => Uint8Array;
}

/** The bytes, in a buffer of their own; null where the text is not base64. */
export function bytesOfBase64(text: string): Uint8Array | null {
  try {
    const native = (Uint8Array as unknown as NativeBase64).fromBase64;
    if (native !== undefined) return native.call(Uint8Array, text);
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
  } catch {
    return null;
  }
}
