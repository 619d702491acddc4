/** The scene as the generator wrote it. */
export function readScene() {
    return JSON.parse(document.getElementById("scene").textContent);
}

/** The scene of a page's HTML, in which no "<" is part of the scene. Quicker than to have the browser make a document of it. */
export function readSceneFrom(html) {
    const begin = html.indexOf(">", html.indexOf('id="scene"')) + 1;
    return JSON.parse(html.slice(begin, html.indexOf("</script>", begin)));
}

/** A label without the quotation marks that messages put around names. */
export const nameOf = (label) => (/^'[^]*'$/.test(label) ? label.slice(1, -1) : label);

/**
 * The name that a person gave. Unnamed objects and lights go by their number, as
 * on the command line.
 */
export function displayName(label, kind, index) {
    const bare = nameOf(label);
    return bare.trim() === "" || /^number \d+$/.test(label) ? `${kind} ${index}` : bare;
}
