#include "model/papers/tables/study_page.h"

namespace choreo {
namespace {

constexpr const char* kPage = R"html(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Which dance is better?</title>
<style>
  body { font: 16px/1.5 system-ui, sans-serif; max-width: 75rem; margin: 1rem auto; padding: 0 1rem; }
  #films { display: grid; grid-template-columns: repeat(auto-fit, minmax(16rem, 1fr)); gap: 1rem; }
  figure { margin: 0; }
  video, img { width: 100%; background: #eee; }
  select, button { font: inherit; padding: .4rem .8rem; }
  [hidden] { display: none; }
</style>
<h1 id="question"></h1>
<p id="place"></p>
<p><button id="play">Play all</button></p>
<div id="films"></div>
<p><button id="next" disabled>Next</button> <span id="hint">Give each dance a rank of its own; 1 is the best.</span></p>
<p id="end" hidden>Thank you. Please send the file that was saved. <a id="save">Save it again</a></p>
<script>
const question = QUESTION, shown = SHOWN;
const at = (id) => document.getElementById(id);
const answers = [];
at("question").textContent = question;

function show() {
  const films = shown.clips[answers.length];
  at("place").textContent = `${answers.length + 1} of ${shown.clips.length}`;
  at("films").replaceChildren(...films.map((film) => {
    const figure = document.createElement("figure");
    const moving = /\.(webm|mp4)$/.test(film);
    const view = document.createElement(moving ? "video" : "img");
    view.src = film;
    if (moving) Object.assign(view, { controls: true, loop: true, playsInline: true });
    const rank = document.createElement("select");
    rank.setAttribute("aria-label", `Rank of ${letter(film)}`);
    rank.append(new Option("rank", ""), ...films.map((_, i) => new Option(i + 1, i + 1)));
    rank.dataset.film = letter(film);
    rank.onchange = check;
    const caption = document.createElement("figcaption");
    caption.append(letter(film), " ", rank);
    figure.append(view, caption);
    return figure;
  }));
  at("play").hidden = !document.querySelector("video");
  at("next").disabled = true;
}
const letter = (film) => film.match(/([A-Z])\.[a-z0-9]+$/)[1];
const ranks = () => [...document.querySelectorAll("select")];
function check() {
  const given = ranks().map((rank) => rank.value);
  at("next").disabled = given.includes("") || new Set(given).size < given.length;
}
at("play").onclick = () => {
  document.querySelectorAll("video").forEach((film, i) => {
    film.currentTime = 0;
    film.muted = i > 0;  // one song
    film.play();
  });
};
at("next").onclick = () => {
  const best = ranks().sort((a, b) => a.value - b.value).map((rank) => rank.dataset.film);
  answers.push({ clip: answers.length + 1, ranking: best });
  if (answers.length < shown.clips.length) return show();
  for (const id of ["films", "play", "next", "hint", "place"]) at(id).hidden = true;
  const file = new Blob([JSON.stringify({ study: shown.study, answers }, null, 2)], { type: "application/json" });
  Object.assign(at("save"), { href: URL.createObjectURL(file), download: "answers.json" });
  at("end").hidden = false;
  at("save").click();
};
show();
</script>
</html>
)html";

// In a script, where "</script>" would end it.
std::string ForScript(const nlohmann::ordered_json& value) {
  std::string text = value.dump();
  for (size_t at = 0; (at = text.find('<', at)) != std::string::npos; at += 6)
    text.replace(at, 1, "\\u003c");
  return text;
}

void Put(const std::string& mark, const std::string& text, std::string* page) {
  page->replace(page->find(mark), mark.size(), text);
}

bool HasExtension(const std::filesystem::path& path, std::initializer_list<const char*> some) {
  for (const char* extension : some)
    if (path.extension() == extension) return true;
  return false;
}

}  // namespace

bool IsFilm(const std::filesystem::path& path) { return HasExtension(path, {".webm", ".mp4"}); }
bool IsPicture(const std::filesystem::path& path) { return HasExtension(path, {".png", ".jpg"}); }

std::string StudyPage(const std::string& question, const nlohmann::ordered_json& shown) {
  std::string page = kPage;
  // Films first: they contain no placeholder.
  Put("SHOWN", ForScript(shown), &page);
  Put("QUESTION", ForScript(question), &page);
  return page;
}

}  // namespace choreo
