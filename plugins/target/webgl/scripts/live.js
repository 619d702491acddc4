import { announce, showNotice, showSceneProblems } from "./messages.js";
import { readSceneFrom } from "./scene.js";

const ENDED = "candela view has ended, or cannot be reached; this is the last picture.";

/** The scene of another generation of this page, from the server of this one. */
async function fetchScene(generation) {
    const response = await fetch(`?live=${generation}`);
    if (!response.ok) throw new Error(`The scene cannot be fetched (${response.status}).`);
    // The server may have gone further meanwhile, and has led to what is newest.
    const newest = Number(new URL(response.url).searchParams.get("live"));
    return { scene: readSceneFrom(await response.text()), generation: newest };
}

/**
 * Keeps the page up to date where `candela view` serves it: the address then says of which generation the page is. `show`
 * takes a scene. Without a server, nothing happens, and the result is false.
 */
export function followScene(show, onError) {
    const parameters = new URLSearchParams(location.search);
    if (!parameters.has("live")) return false;
    let shown = Number(parameters.get("live")), wanted = shown, isFetching = false;
    const update = async () => {
        if (isFetching) return;
        isFetching = true;
        try {
            while (wanted > shown) {
                const { scene, generation } = await fetchScene(wanted);
                show(scene);
                shown = generation;
                history.replaceState(null, "", `?live=${shown}${location.hash}`);
                announce("The scene's file has been saved; this is what it shows now.");
            }
            onError(null);
        } catch (error) {
            onError(error);
        } finally {
            isFetching = false;
        }
    };
    const events = new EventSource("events");
    events.addEventListener("scene", (event) => {
        wanted = Number(event.data);
        if (wanted > shown) update();
    });
    events.addEventListener("problems", (event) => showSceneProblems(JSON.parse(event.data)));
    events.addEventListener("open", () => showNotice(""));
    events.addEventListener("error", () => showNotice(ENDED));
    return true;
}
