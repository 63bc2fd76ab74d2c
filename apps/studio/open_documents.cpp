#include "studio/open_documents.h"

#include <algorithm>

namespace relievo::app::studio {

std::shared_ptr<Engine> OpenDocuments::find(const std::string& document) {
  const Lock lock(mutex_);
  const auto found = std::ranges::find(entries_, document, &Entry::document);
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return found->engine;
}

std::shared_ptr<Engine> OpenDocuments::open(const std::string& document, const std::string& tab) {
  const Lock lock(mutex_);
  if (!tab.empty()) {
    forget_tab(tab);
    tabs_.push_front({tab, document});
    if (tabs_.size() > most_tabs) tabs_.pop_back();
  }
  const auto found = std::ranges::find(entries_, document, &Entry::document);
  if (found == entries_.end())
    entries_.push_front({document, std::make_shared<Engine>(changed_)});
  else
    entries_.splice(entries_.begin(), entries_, found);
  close_others();
  return entries_.front().engine;
}

bool OpenDocuments::is_open(const std::string& document) {
  const Lock lock(mutex_);
  return std::ranges::find(entries_, document, &Entry::document) != entries_.end();
}

bool OpenDocuments::close(const std::string& document, const std::string& tab) {
  const Lock lock(mutex_);
  std::erase(tabs_, Tab{tab, document});
  if (is_shown(document)) return false;
  const auto found = std::ranges::find(entries_, document, &Entry::document);
  if (found != entries_.end()) close(found);
  forget_idle();
  return true;
}

void OpenDocuments::leave(const std::string& tab) {
  const Lock lock(mutex_);
  forget_tab(tab);
}

// Forgets a tab that was closed or now shows another document. The caller has locked `mutex_`.
void OpenDocuments::forget_tab(const std::string& tab) {
  std::erase_if(tabs_, [&](const Tab& each) { return each.name == tab; });
}

std::vector<OpenDocuments::Entry> OpenDocuments::all() {
  const Lock lock(mutex_);
  forget_idle();
  return {entries_.begin(), entries_.end()};
}

bool OpenDocuments::is_shown(const std::string& document) const {
  return std::ranges::find(tabs_, document, &Tab::document) != tabs_.end();
}

// Closes the document of the entry, and returns the next entry. The caller has locked `mutex_`.
std::list<OpenDocuments::Entry>::iterator OpenDocuments::close(std::list<Entry>::iterator entry) {
  entry->engine->cancel();
  closing_.push_back(entry->engine);
  return entries_.erase(entry);
}

// Closes documents beyond the limits, but never the one that was used last. The caller has locked `mutex_`.
void OpenDocuments::close_others() {
  std::size_t open = 1, hidden = 0;
  for (auto entry = std::next(entries_.begin()); entry != entries_.end();) {
    const bool is_hidden = !is_shown(entry->document);
    if (open < most_open && (!is_hidden || hidden < most_hidden)) {
      ++open;
      hidden += is_hidden ? 1 : 0;
      ++entry;
      continue;
    }
    entry = close(entry);
  }
  forget_idle();
}

void OpenDocuments::work() {
  const Lock lock(mutex_);
  for (const Entry& entry : entries_) entry.engine->work();
  for (const std::shared_ptr<Engine>& engine : closing_) engine->work();
  forget_idle();
}

// Destroys the idle engines of closed documents. The destructor of a busy engine would wait for its work.
void OpenDocuments::forget_idle() {
  std::erase_if(closing_, [](const std::shared_ptr<Engine>& engine) { return engine->is_idle(); });
}

}  // namespace relievo::app::studio
