// main DIAMETER VELOCITY: one parcel against a moving wall that is oblique to the axes.
#include <cstdio>
#include <cstdlib>

#include "makeRecoilRebound.C"

int main(int argc, char** argv)
{
    using namespace Foam;
    if (argc != 3) return 2;
    const double velocity = std::atof(argv[2]);
    basicKinematicCloud cloud;
    cloud.normal = vector(0.6, 0.0, 0.8);
    cloud.patchVelocity = vector(1.0, 2.0, 0.5);
    const vector slip(0.8, 0.0, -0.6);
    recoilRebound<basicKinematicCloud> model(dictionary(), cloud);
    vector U = cloud.patchVelocity;
    U += velocity*cloud.normal;
    U += 3.0*slip;
    basicKinematicCloud::parcelType parcel(U, std::atof(argv[1]));
    bool keep = false;
    const bool done = model.clone()->correct(parcel, wallPolyPatch(), keep);
    vector after = parcel.U();
    after -= cloud.patchVelocity;
    std::printf("restitution %.12f\n", -(after & cloud.normal)/velocity);
    std::printf("tangential %.12f active %d kept %d\n", after & slip, parcel.active(), keep && done);
    return 0;
}
