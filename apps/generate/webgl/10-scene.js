// The scene as the generator wrote it, and its arrays as numbers.

function readScene() {
    return JSON.parse(document.getElementById("scene").textContent);
}

function bytesOf(base64) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
}

const floatsOf = (base64) => new Float32Array(bytesOf(base64).buffer);
const integersOf = (base64) => new Uint32Array(bytesOf(base64).buffer);

/// A label as a person reads it: without the quotation marks that messages put around names. Things without a name go by
/// their number, as on the command line.
function shownLabel(label, kind, index) {
    const bare = /^'[^]*'$/.test(label) ? label.slice(1, -1) : label;
    return bare.trim() === "" || /^number \d+$/.test(label) ? `${kind} ${index}` : bare;
}
