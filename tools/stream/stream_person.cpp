#include "tools/stream/stream_person.h"

#include <utility>

#include "articulated/try.h"
#include "assets/bounds/bound_presets.h"

namespace foretouch::tools {

Result<std::vector<PersonStream>> makePersons(const PersonRequest& request,
                                              const std::vector<StreamSolver>& solvers,
                                              const Scene& scene) {
  std::vector<PersonStream> persons;
  if (!request.isAsked()) return persons;
  FORETOUCH_TRY(const auto bounds, readBounds(request.boundsPath));
  for (const StreamSolver& solver : solvers) {
    const PersonStreamOptions options{bounds, request.model, request.aheadUs,
                                      bracketOptionsOf(solver.options())};
    FORETOUCH_TRY(auto person,
                  inFile(PersonStream::make(solver.id(), solver.avatar(), scene, options),
                         request.boundsPath));
    persons.push_back(std::move(person));
  }
  return persons;
}

}  // namespace foretouch::tools
