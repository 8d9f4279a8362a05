#include "studio/page.h"

#include "studio/page_files.h"

namespace choreo::studio {

std::span<const PageFile> PageFiles() {
  static const PageFile kFiles[] = {
      {"/index.html", "text/html; charset=utf-8", EmbeddedIndexHtml()},
      {"/studio.js", "text/javascript; charset=utf-8", EmbeddedStudioJs()},
      {"/microphone.js", "text/javascript; charset=utf-8", EmbeddedMicrophoneJs()},
      {"/studio.css", "text/css; charset=utf-8", EmbeddedStudioCss()},
  };
  return kFiles;
}

const PageFile* FindPageFile(std::string_view path) {
  if (path == "/") path = "/index.html";
  for (const PageFile& file : PageFiles())
    if (file.path == path) return &file;
  return nullptr;
}

}  // namespace choreo::studio
