/** From 0-255 to linear intensities; sRGB is decoded by IEC 61966-2-1. */
export function decodeColor(color, isSrgb) {
    return color.map((byte) => {
        const c = Math.min(byte, 255) / 255;
        if (!isSrgb) return c;
        return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
    });
}

export const toHex = (color) =>
    "#" + color.map((c) => Math.round(Math.min(255, Math.max(0, c))).toString(16).padStart(2, "0")).join("");
export const fromHex = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
