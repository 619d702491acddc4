/** The scene as the generator wrote it; its arrays are apart (arrays.js). */
export function readScene() {
    return JSON.parse(document.getElementById("scene").textContent);
}

/** A label without the quotation marks that messages put around names. */
export const nameOf = (label) => (/^'[^]*'$/.test(label) ? label.slice(1, -1) : label);

/**
 * The name from the scene file. Unnamed objects and lights are called by their number, as on the command line.
 */
export function displayName(label, kind, index) {
    const bare = nameOf(label);
    return bare.trim() === "" || /^number \d+$/.test(label) ? `${kind} ${index}` : bare;
}
