// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/serialization/Serializable.hpp>

namespace yade {

// Periodic cell; the columns of hSize are its edges [m].
class Cell : public Serializable {
    Matrix3r _invTrsf, _trsfInc, _vGradTimesPrevH;
    Vector3r _size, _cos, _refSize;
    bool _hasShear;
    Matrix3r _shearTrsf, _unshearTrsf;
    double _glShearTrsfMatrix[16];

public:
    Matrix3r trsf;
    Matrix3r refHSize;
    Matrix3r hSize;
    Matrix3r prevHSize;
    Matrix3r velGrad;
    Matrix3r nextVelGrad;
    Matrix3r prevVelGrad;
    int homoDeform;
    bool velGradChanged;
    bool flipFlippable;

    Cell();
    YADE_ABI_STOCK(Cell)
    const Vector3r& getSize() const { return _size; }
    const Vector3r& getCos() const { return _cos; }
    bool hasShear() const { return _hasShear; }
    const Matrix3r& getShearTrsf() const { return _shearTrsf; }
    const Matrix3r& getUnshearTrsf() const { return _unshearTrsf; }
    Real getVolume() const;
    Vector3r shearPt(const Vector3r&) const;
    Vector3r unshearPt(const Vector3r&) const;
    Vector3r wrapShearedPt(const Vector3r&) const;
    Vector3r intrShiftPos(const Vector3i& cells) const { return hSize * cells.cast<Real>(); }
    Vector3r intrShiftVel(const Vector3i& cells) const { return _vGradTimesPrevH * cells.cast<Real>(); }
    void setBox(const Vector3r&);
    void setHSize(const Matrix3r&);
    void setVelGrad(const Matrix3r&);
    void integrateAndUpdate(Real dt);
};
YADE_ABI_STOCK_END(Cell, 1104)

} // namespace yade
