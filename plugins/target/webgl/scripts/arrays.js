import { decodeBase64 } from "./base64.js";

/** Texts of arrays that have come since the page was opened, by their names. The others are elements of the page. */
const fetched = new Map();

const elementOf = (name) => document.getElementById(name);

export const hasArray = (name) => fetched.has(name) || elementOf(name) !== null;
export const addArray = (name, base64) => fetched.set(name, base64);

/** Frees what came for scenes that are no longer shown; `names` are those of the scene that is. */
export function keepArrays(names) {
    const kept = new Set(names);
    for (const name of [...fetched.keys()]) {
        if (!kept.has(name)) fetched.delete(name);
    }
}

/** What an array's name stands for. A name is made from the array's bytes, so that arrays of one name are equal. */
export const bytesOf = (name) => decodeBase64(fetched.get(name) ?? elementOf(name).textContent);
export const floatsOf = (name) => new Float32Array(bytesOf(name).buffer);
export const indicesOf = (name) => new Uint32Array(bytesOf(name).buffer);
