// Keeps the open documents, each with its own engine. Tested by apps/studio/tests/tabs.test.mjs.
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "relievo/core/parallel.h"
#include "studio/engine.h"

namespace relievo::app::studio {

// The open documents and their engines. Every method may be called from any thread.
class OpenDocuments {
 public:
  // The largest number of open documents that no tab shows, and the largest number of all open documents.
  // Beyond these limits, the least recently used document is closed. If a tab shows that document, the tab
  // opens it again.
  static constexpr std::size_t most_hidden = 1, most_open = 6;

  // The largest number of known tabs. Beyond this number, the tab that has shown its document longest is
  // forgotten. This limit is needed because a tab that crashed never reports that it is closed.
  static constexpr std::size_t most_tabs = 64;

  struct Entry {
    std::string document;
    std::shared_ptr<Engine> engine;
  };

  // Passes `changed` to the engines; see Engine.
  explicit OpenDocuments(std::function<void()> changed = {}) : changed_(std::move(changed)) {}

  // Returns the document's engine; null if the document is not open.
  std::shared_ptr<Engine> find(const std::string& document);

  // Opens the document if it is not open, and returns its engine. From then on the tab `tab` shows this
  // document and no other. If `tab` is empty, no tab shows it.
  std::shared_ptr<Engine> open(const std::string& document, const std::string& tab);

  bool is_open(const std::string& document);

  // Closes a document. Returns false, and leaves it open, if a tab other than `tab` shows it.
  bool close(const std::string& document, const std::string& tab);

  // Must be called when a tab is closed.
  void leave(const std::string& tab);

  // On a system without threads, does the requested work of all engines; see Engine::work().
  void work();

  // Returns all open documents, the most recently used one first.
  std::vector<Entry> all();

 private:
  // A tab, and the document that it shows.
  struct Tab {
    std::string name, document;
    bool operator==(const Tab&) const = default;
  };

  bool is_shown(const std::string& document) const;
  void forget_tab(const std::string& tab);
  std::list<Entry>::iterator close(std::list<Entry>::iterator entry);
  void close_others();
  void forget_idle();

  std::function<void()> changed_;
  Mutex mutex_;
  std::list<Entry> entries_;
  std::list<Tab> tabs_;                           // the tab that opened its document last comes first
  std::vector<std::shared_ptr<Engine>> closing_;  // engines of closed documents, until their work ends
};

}  // namespace relievo::app::studio
