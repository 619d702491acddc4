/** The scene as the generator wrote it into a page. */
export function readScene(page) {
    return JSON.parse(page.getElementById("scene").textContent);
}

/**
 * A label without the quotation marks that messages put around names. Unnamed objects and lights go by their number, as
 * on the command line.
 */
export function displayName(label, kind, index) {
    const bare = /^'[^]*'$/.test(label) ? label.slice(1, -1) : label;
    return bare.trim() === "" || /^number \d+$/.test(label) ? `${kind} ${index}` : bare;
}
