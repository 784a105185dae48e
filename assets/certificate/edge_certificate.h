// assets/certificate/edge_certificate.h: why edges of a robot are clear, for a stranger to check
// (docs/certificates.md): their clearance from the scene, and that of own links from each other.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/certificate/certificate_writer.h"
#include "middleware/edges/edge_query.h"

namespace foretouch {

/// What foretouch-verify reads, and what was found.
struct EdgeCertificate {
  std::string scene, avatar, edges, proof;  ///< Texts of its four files.
  std::vector<EdgeAnswer> answers;          ///< Of each edge.
  std::vector<bool> isProven;  ///< Of each edge. Not of a clear one if it comes so near to
                               ///< something that no proof was found.
  CertificateCounts counts;    ///< `unproven` counts edges.
};

/// `count` edges: q0 and q1 each hold `count` configurations one after the other. The same texts on
/// every machine that answers alike. Errors: as EdgeQuery::answer() (Error::index is the edge); no
/// edge; props, which are not of the one scene that a certificate is about; pair rules with radii
/// of their own.
[[nodiscard]] Result<EdgeCertificate> certifyEdges(const EdgeQuery& edges, const double* q0,
                                                   const double* q1, std::size_t count);

/// Writes scene.obj, avatar.json, edges.txt and certificate.txt; makes the folder.
[[nodiscard]] Result<Done> writeEdgeCertificate(const EdgeCertificate& certificate,
                                                const std::string& folder);

}  // namespace foretouch
