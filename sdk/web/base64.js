export function decodeBase64(base64) {
    if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
    const binary = atob(base64);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
}

export const decodeFloats = (base64) => new Float32Array(decodeBase64(base64).buffer);
export const decodeIndices = (base64) => new Uint32Array(decodeBase64(base64).buffer);

/** UTF-8 in base64url without padding (RFC 4648, section 5), which a URL's fragment can hold. */
export function encodeTextForUrl(text) {
    const binary = Array.from(new TextEncoder().encode(text), (byte) => String.fromCharCode(byte)).join("");
    return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** The inverse of encodeTextForUrl. Throws if the text is not base64url or not UTF-8. */
export function decodeTextFromUrl(base64url) {
    const bytes = decodeBase64(base64url.replaceAll("-", "+").replaceAll("_", "/"));
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
}
