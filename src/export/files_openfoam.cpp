#include "export/export_job.hpp"
#include "export/files.hpp"

namespace recoil {
namespace {

constexpr const char* class_text = R"(@HEADING@//
// Build:  cd recoilRebound && wmake        (in a shell with OpenFOAM's environment)
// Use:    libs ("librecoilRebound.so");    in system/controlDict
//         patchInteractionModel recoilRebound;    in the cloud's subModels; it has no coefficients
// Parcels hit with the normal velocity relative to the patch; the tangential one is kept.
#ifndef recoilRebound_H
#define recoilRebound_H

#include "PatchInteractionModel.H"

namespace Foam
{

template<class CloudType>
class recoilRebound
:
    public PatchInteractionModel<CloudType>
{
public:

    TypeName("recoilRebound");

    recoilRebound(const dictionary& dict, CloudType& cloud)
    :
        PatchInteractionModel<CloudType>(dict, cloud, typeName)
    {}

    recoilRebound(const recoilRebound<CloudType>& other)
    :
        PatchInteractionModel<CloudType>(other)
    {}

    virtual autoPtr<PatchInteractionModel<CloudType>> clone() const
    {
        return autoPtr<PatchInteractionModel<CloudType>>
        (
            new recoilRebound<CloudType>(*this)
        );
    }

    virtual ~recoilRebound() = default;

    //- Rebound with the fitted e(V, d), or stay
    virtual bool correct
    (
        typename CloudType::parcelType& p,
        const polyPatch& pp,
        bool& keepParticle
    );
};

} // End namespace Foam

#ifdef NoRepository
    #include "recoilRebound.C"
#endif

#endif
)";

constexpr const char* body_text = R"(@HEADING@
#include "recoilRebound.H"

#include <cmath>

namespace
{
using std::exp;
using std::log;
using std::sqrt;

@TABLE@} // End anonymous namespace


template<class CloudType>
bool Foam::recoilRebound<CloudType>::correct
(
    typename CloudType::parcelType& p,
    const polyPatch& pp,
    bool& keepParticle
)
{
    if (!isA<wallPolyPatch>(pp))
    {
        return false;
    }

    vector nw;
    vector Up;
    this->owner().patchData(p, pp, nw, Up);

    vector& U = p.U();
    U -= Up;
    const scalar Un = U & nw;
    keepParticle = true;
    p.active(true);

    if (Un > 0)
    {
        const scalar e = recoil_restitution(p.d(), Un);
        if (e > 0)
        {
            U -= (1.0 + e)*Un*nw;
        }
        else
        {
            p.active(false);
            U = vector(0, 0, 0);
        }
    }

    U += Up;
    return true;
}
)";

constexpr const char* make_text = R"(#include "kinematicCloud.H"
#include "basicKinematicCloud.H"
#include "recoilRebound.H"

makePatchInteractionModelType(recoilRebound, basicKinematicCloud);
)";

constexpr const char* files_text = R"(makeRecoilRebound.C

LIB = $(FOAM_USER_LIBBIN)/librecoilRebound
)";

constexpr const char* options_text = R"(EXE_INC = \
    -I$(LIB_SRC)/finiteVolume/lnInclude \
    -I$(LIB_SRC)/meshTools/lnInclude \
    -I$(LIB_SRC)/lagrangian/basic/lnInclude \
    -I$(LIB_SRC)/lagrangian/distributionModels/lnInclude \
    -I$(LIB_SRC)/lagrangian/intermediate/lnInclude \
    -I$(LIB_SRC)/transportModels/compressible/lnInclude \
    -I$(LIB_SRC)/thermophysicalModels/basic/lnInclude \
    -I$(LIB_SRC)/regionModels/regionModel/lnInclude \
    -I$(LIB_SRC)/regionModels/surfaceFilmModels/lnInclude

LIB_LIBS = -llagrangianIntermediate
)";

}  // namespace

std::vector<WholeFile> openfoam_files(const ExportJob& job) {
  const std::string heading = commented(job.heading, "// ");
  const std::filesystem::path folder = "recoilRebound";
  return {
      {folder / "recoilRebound.H", filled(class_text, {{"HEADING", heading}})},
      {folder / "recoilRebound.C",
       filled(body_text, {{"HEADING", heading}, {"TABLE", lookup_in_c(*job.lookup)}})},
      {folder / "makeRecoilRebound.C", make_text},
      {folder / "Make" / "files", files_text},
      {folder / "Make" / "options", options_text},
  };
}

}  // namespace recoil
