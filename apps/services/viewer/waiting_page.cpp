#include "viewer/waiting_page.h"

namespace view {

std::string_view waiting_page() {
    return R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; connect-src 'self'; img-src data:; base-uri 'none'; form-action 'none'">
<link rel="icon" href="data:,">
<title>Candela</title>
<style>
body { margin: 0; padding: 3rem clamp(1rem, 6vw, 6rem); font: 16px/1.5 system-ui, sans-serif; background: #eceae6; color: #1f1e1c; }
pre { padding: 1rem; overflow-x: auto; background: #fbfaf8; border-left: 4px solid #b3261e; font-size: 14px; }
@media (prefers-color-scheme: dark) { body { background: #121211; color: #eceae5; } pre { background: #1a1a18; border-color: #ff8a80; } }
[hidden] { display: none; }
</style>
</head>
<body>
<main>
<h1>There is nothing to show yet</h1>
<p id="why">The scene is being read.</p>
<pre id="scene-problems-text" role="alert" tabindex="0" hidden></pre>
</main>
<script>
const events = new EventSource("events");
events.addEventListener("scene", (event) => { if (Number(event.data) > 0) location.reload(); });
events.addEventListener("problems", (event) => {
    const text = JSON.parse(event.data), shown = document.getElementById("scene-problems-text");
    shown.textContent = text;
    shown.hidden = text === "";
    document.getElementById("why").textContent = text === "" ? "The scene is being read."
        : "The scene has errors. Fix them and save the file; this page will then show the scene.";
});
</script>
</body>
</html>
)";
}

}  // namespace view
