/** Puts an element over another one, in the same picture area. */
export function layOver(overlay, picture) {
    const box = picture.getBoundingClientRect(), around = overlay.parentElement.getBoundingClientRect();
    Object.assign(overlay.style, { left: `${box.left - around.left}px`, top: `${box.top - around.top}px`, width: `${box.width}px`, height: `${box.height}px` });
}

/**
 * Calls `place` whenever the picture may have moved: also without a change of size, when there is less room around it, and when
 * pictures next to it come and go ("arranged", an event of the picture area). Returns a function that ends it.
 */
export function onMoved(overlay, picture, place) {
    const observer = new ResizeObserver(place);
    observer.observe(picture);
    observer.observe(overlay.parentElement);
    const { parentElement } = overlay;
    parentElement.addEventListener("arranged", place);
    return () => {
        observer.disconnect();
        parentElement.removeEventListener("arranged", place);
    };
}
