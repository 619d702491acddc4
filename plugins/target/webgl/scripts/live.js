import { announce, showNotice, showSceneProblems } from "./messages.js";
import { readSceneFrom } from "./scene.js";

const RETRY_MS = 1000;
const ENDED = "candela view has ended, or cannot be reached; this is the last picture.";

/** The scene of another generation of this page, from the server of this one. */
async function fetchScene(generation) {
    const response = await fetch(`?live=${generation}`);
    if (!response.ok) throw new Error(`The scene cannot be fetched (${response.status}).`);
    // The server may have gone further meanwhile, and has led to what is newest.
    const newest = Number(new URL(response.url).searchParams.get("live"));
    return { scene: readSceneFrom(await response.text()), generation: newest };
}

/** Whether `candela view` serves the page: the address then says of which generation it is. */
export const isServed = () => new URLSearchParams(location.search).has("live");

/**
 * Keeps the page up to date where `candela view` serves it. `show` takes a scene. Without a server, nothing happens, and the result is false.
 */
export function followScene(show, onError) {
    if (!isServed()) return false;
    let shown = Number(new URLSearchParams(location.search).get("live")), wanted = shown, isFetching = false;
    const update = async () => {
        if (isFetching) return;
        isFetching = true;
        let isMissing = false;
        try {
            while (wanted > shown) {
                isMissing = true;
                const { scene, generation } = await fetchScene(wanted);
                isMissing = false;
                show(scene);
                shown = generation;
                history.replaceState(null, "", `?live=${shown}${location.hash}`);
                announce("The scene's file has been saved; this is what it shows now.");
            }
            onError(null);
        } catch (error) {
            onError(error);
            // No event may come any more that would have it fetched.
            if (isMissing) setTimeout(update, RETRY_MS);
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
