// SPDX-License-Identifier: GPL-2.0-or-later
// Class numbers, by which dispatchers choose a functor.
#pragma once

#include <memory>
#include <stdexcept>

namespace yade {

class Indexable {
protected:
    void createIndex(); // call it in the constructor of every class that has REGISTER_CLASS_INDEX
    virtual void incrementMaxCurrentlyUsedClassIndexOfKin() { numberless(); }
    virtual int& modifyClassIndex() { numberless(); }

public:
    Indexable() { }
    virtual ~Indexable() { }
    virtual const int& getClassIndex() const { numberless(); }
    virtual const int& getBaseClassIndex(int) const { numberless(); }
    virtual const int& getMaxCurrentlyUsedClassIndexOfKin() const { numberless(); }

private:
    [[noreturn]] static void numberless() { throw std::logic_error("This class lacks REGISTER_CLASS_INDEX."); }
};
static_assert(sizeof(Indexable) == 8, "YADE 2023.02a: size of Indexable");

} // namespace yade

// The number is one variable a process: the dynamic linker unites it with that of the loaded YADE.
#define YADE_ABI_CLASS_INDEX                                                                                                \
private:                                                                                                                    \
    static int& modifyClassIndexStatic()                                                                                    \
    {                                                                                                                       \
        static int index = -1;                                                                                              \
        return index;                                                                                                       \
    }                                                                                                                       \
                                                                                                                            \
public:                                                                                                                     \
    static const int& getClassIndexStatic() { return modifyClassIndexStatic(); }

// In a plugin's class.
#define REGISTER_CLASS_INDEX(K, Base)                                                                                       \
    YADE_ABI_CLASS_INDEX                                                                                                    \
protected:                                                                                                                  \
    int& modifyClassIndex() override { return modifyClassIndexStatic(); }                                                   \
                                                                                                                            \
public:                                                                                                                     \
    const int& getClassIndex() const override { return getClassIndexStatic(); }                                             \
    const int& getBaseClassIndex(int depth) const override                                                                  \
    {                                                                                                                       \
        static const std::unique_ptr<const Base> parent(new Base);                                                          \
        return depth == 1 ? parent->getClassIndex() : parent->getBaseClassIndex(depth - 1);                                 \
    }

// In a class of YADE.
#define YADE_ABI_STOCK_INDEX(K)                                                                                             \
    YADE_ABI_CLASS_INDEX                                                                                                    \
protected:                                                                                                                  \
    int& modifyClassIndex() override;                                                                                       \
                                                                                                                            \
public:                                                                                                                     \
    const int& getClassIndex() const override;                                                                              \
    const int& getBaseClassIndex(int) const override;

// In a class of YADE that heads a family: Shape, Bound, Material, State, IGeom, IPhys.
#define YADE_ABI_STOCK_INDEX_HEAD(K)                                                                                        \
    YADE_ABI_STOCK_INDEX(K)                                                                                                 \
    const int& getMaxCurrentlyUsedClassIndexOfKin() const override;                                                         \
                                                                                                                            \
protected:                                                                                                                  \
    void incrementMaxCurrentlyUsedClassIndexOfKin() override;                                                               \
                                                                                                                            \
public:
