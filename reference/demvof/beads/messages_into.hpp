// What a library says on stderr on its own account goes into its log.
#pragma once

#include <string>

namespace demvof {

// From here to the end of the scope stderr is appended to `file`; left as it is where that cannot be opened.
class MessagesInto {
 public:
  explicit MessagesInto(const std::string& file);
  ~MessagesInto();
  MessagesInto(const MessagesInto&) = delete;
  MessagesInto& operator=(const MessagesInto&) = delete;
  MessagesInto(MessagesInto&&) = delete;
  MessagesInto& operator=(MessagesInto&&) = delete;

 private:
  int kept_ = -1;  // stderr as it was
};

}  // namespace demvof
