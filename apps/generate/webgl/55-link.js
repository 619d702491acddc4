// The state in the address: "#s=" and what differs from the scene, as base64url of JSON.

const LINK_VERSION = 1;

function toBase64Url(text) {
    const bytes = new TextEncoder().encode(text);
    const binary = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
    return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

function fromBase64Url(text) {
    const bytes = bytesOf(text.replaceAll("-", "+").replaceAll("_", "/"));
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
}

function fragmentOf(settings) {
    if (!settings.isChanged()) return "";
    return "#s=" + toBase64Url(JSON.stringify({ version: LINK_VERSION, set: Object.fromEntries(settings.changes) }));
}

/// What a fragment says: a list of paths and values, or null where it is nobody's or broken.
function readFragment(fragment) {
    try {
        const state = JSON.parse(fromBase64Url(fragment.slice(3)));
        return state.version === LINK_VERSION && state.set instanceof Object ? Object.entries(state.set) : null;
    } catch {
        return null;
    }
}

/// Puts the settings where a fragment says, and answers what to tell about it ("" where all was well).
function restore(settings, fragment) {
    if (fragment.length < 2 && settings.isChanged()) settings.reset();
    if (!fragment.startsWith("#s=")) return "";
    const entries = readFragment(fragment);
    if (entries === null) return "The link's settings cannot be read; this is the scene without them.";
    settings.changes.clear();
    // Observers are judged as a whole: one value may only make sense with the next.
    const observer = { ...settings.observer() };
    let refused = 0;
    for (const [path, value] of entries) {
        const found = settings.find(path);
        if (found === null || complaint(found.parameter, value) !== null) refused += 1;
        else if (path.startsWith("observer.")) observer[path.slice(9)] = value;
        else settings.put(path, value);
    }
    if (observerComplaint(observer) === null) {
        for (const { name } of settings.observerParameters()) settings.put(`observer.${name}`, observer[name]);
    } else {
        refused += 1;
    }
    settings.tell(null);
    if (refused === 0) return "";
    return refused === 1
        ? "One of the link's settings does not fit this scene and was left out."
        : `${refused} of the link's settings do not fit this scene and were left out.`;
}
