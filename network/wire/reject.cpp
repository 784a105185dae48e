#include "network/wire/messages.h"

namespace foretouch {

const char* toString(Reject reject) {
  switch (reject) {
    case Reject::None: return "none";
    case Reject::Length: return "length";
    case Reject::Fingerprint: return "fingerprint";
    case Reject::Version: return "version";
    case Reject::Limit: return "limit";
    case Reject::NonFinite: return "non-finite";
    case Reject::NonUnit: return "non-unit";
    case Reject::OutOfRange: return "out-of-range";
    case Reject::BadName: return "bad-name";
    case Reject::BadIndex: return "bad-index";
    case Reject::BadHierarchy: return "bad-hierarchy";
    case Reject::BadHash: return "bad-hash";
    case Reject::UnknownAvatar: return "unknown-avatar";
    case Reject::NoMatch: return "no-match";
    case Reject::OldGeneration: return "old-generation";
    case Reject::UnknownSkeleton: return "unknown-skeleton";
    case Reject::SkeletonMismatch: return "skeleton-mismatch";
    case Reject::Duplicate: return "duplicate";
    case Reject::OutOfOrder: return "out-of-order";
    case Reject::StaleStamp: return "stale-stamp";
    case Reject::FutureStamp: return "future-stamp";
    case Reject::OldSession: return "old-session";
    case Reject::FutureSession: return "future-session";
    case Reject::Late: return "late";
    case Reject::UnknownBody: return "unknown-body";
    case Reject::HeldFast: return "held-fast";
    case Reject::UnknownShape: return "unknown-shape";
    case Reject::CarrierLoop: return "carrier-loop";
    case Reject::SolidCarrier: return "solid-carrier";
    case Reject::OtherSender: return "other-sender";
    case Reject::Unauthenticated: return "unauthenticated";
    case Reject::Replayed: return "replayed";
    case Reject::Overrun: return "overrun";
  }
  return "none";
}

}  // namespace foretouch
