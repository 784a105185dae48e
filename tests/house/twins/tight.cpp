// The other half: the same name by another law, in a source that does not see the header.
namespace foretouch::house::twins {

float roundedUp(double x) {
  return static_cast<float>(x);
}

}  // namespace foretouch::house::twins
