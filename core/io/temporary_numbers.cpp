#include "core/io/temporary_numbers.h"

namespace odolab {

void TemporaryNumbers::append(const std::vector<double>& numbers) {
  if (!file_ && !has_failed_) file_.reset(std::tmpfile());
  has_failed_ = has_failed_ || !file_;
  if (!has_failed_) {
    // Behind what is known to be whole: a block that did not fit stays in memory, and so does all after it.
    const bool whole = std::fseek(file_.get(), static_cast<long>(written_ * sizeof(double)), SEEK_SET) == 0 &&
                       std::fwrite(numbers.data(), sizeof(double), numbers.size(), file_.get()) == numbers.size() &&
                       std::fflush(file_.get()) == 0;
    if (whole) {
      written_ += numbers.size();
      return;
    }
    has_failed_ = true;
  }
  in_memory_.insert(in_memory_.end(), numbers.begin(), numbers.end());
}

Result<std::vector<double>> TemporaryNumbers::all() const {
  std::vector<double> numbers(written_);
  if (written_ > 0 && (std::fseek(file_.get(), 0, SEEK_SET) != 0 ||
                       std::fread(numbers.data(), sizeof(double), written_, file_.get()) != written_))
    return Error{"the temporary file of this run", "nothing that can be read", "what was written into it"};
  numbers.insert(numbers.end(), in_memory_.begin(), in_memory_.end());
  return numbers;
}

}  // namespace odolab
