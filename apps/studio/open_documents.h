// Keeps the open documents, each with its scan and an engine of its own. Tested by
// apps/studio/tests/tabs.test.mjs.
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "relievo/core/parallel.h"
#include "studio/engine.h"

namespace relievo::app::studio {

// Every method may be called from any thread.
class OpenDocuments {
 public:
  // The largest number of open documents that no tab shows, and of all open documents. Beyond these, the
  // least recently used document is closed; a tab that shows it opens it anew.
  static constexpr std::size_t most_hidden = 1, most_open = 6;

  // The largest number of tabs that are known. Beyond it, the tab that opened its document first is
  // forgotten: a tab that has crashed does not report that it is closed.
  static constexpr std::size_t most_tabs = 64;

  struct Entry {
    std::string document;
    std::shared_ptr<Engine> engine;
  };

  // `changed` is passed to the engines, which call it if there are no threads.
  explicit OpenDocuments(std::function<void()> changed = {}) : changed_(std::move(changed)) {}

  // Returns the document's engine; null if the document is not open.
  std::shared_ptr<Engine> find(const std::string& document);

  // Opens the document if it is not open, and returns its engine. From now on the tab `tab` shows only this
  // document; no tab does if `tab` is empty.
  std::shared_ptr<Engine> open(const std::string& document, const std::string& tab);

  bool is_open(const std::string& document);

  // Closes a document. Returns false, and leaves it open, if a tab other than `tab` shows it.
  bool close(const std::string& document, const std::string& tab);

  // Call this when a tab is closed.
  void leave(const std::string& tab);

  // Without threads, this does the requested work of the engines, see Engine::work().
  void work();

  // Returns all open documents, the one used last first.
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
  std::list<Tab> tabs_;                           // the one that opened its document last is first
  std::vector<std::shared_ptr<Engine>> closing_;  // of closed documents, until their cancelled work ends
};

}  // namespace relievo::app::studio
