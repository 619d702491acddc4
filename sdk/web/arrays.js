import { decodeBase64 } from "./base64.js";

/** The texts of arrays received since the page was opened, by name. The others are elements of the page. */
const fetched = new Map();

const elementOf = (name) => document.getElementById(name);

export const hasArray = (name) => fetched.has(name) || elementOf(name) !== null;
export const addArray = (name, base64) => fetched.set(name, base64);

/** Frees arrays of scenes that are no longer shown; `names` are those of the current scene. */
export function keepArrays(names) {
    const kept = new Set(names);
    for (const name of [...fetched.keys()]) {
        if (!kept.has(name)) fetched.delete(name);
    }
}

/** The array of that name. Names are made from the arrays' bytes, so that arrays of the same name are equal. */
export const bytesOf = (name) => decodeBase64(fetched.get(name) ?? elementOf(name).textContent);
export const floatsOf = (name) => new Float32Array(bytesOf(name).buffer);
export const indicesOf = (name) => new Uint32Array(bytesOf(name).buffer);
