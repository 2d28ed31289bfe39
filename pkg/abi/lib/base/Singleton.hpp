// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

// One object a process; the instances (Omega, ClassFactory, Logging) live in the loaded YADE.
template <class T> class Singleton {
protected:
    static T* self;

public:
    static T& instance();
};
