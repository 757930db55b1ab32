// Mutants of the golden vectors: messages nearly right, in ways that reach every stage of the decoder.
#pragma once

#include "vectors.h"

#include <random>

namespace lampblack::protocol
{

/// The same seed gives the same mutants everywhere.
class Mutator
{
public:
    /// `vectors` is protocol/vectors; cases with limits of their own are left out.
    Mutator(const QString& vectors, quint32 seed);

    Case next();

private:
    int below(int bound); ///< 0 to bound - 1
    bool chance(int percent) { return below(100) < percent; }

    void changeBytes(QByteArray& bytes);
    void changeTree(Case& message);
    void changePlanes(Case& message);
    void repairPlanes(Case& message);
    QJsonValue changedValue(const QJsonValue& value);
    QJsonObject changedObject(QJsonObject object);
    QJsonValue oddValue();

    QVector<Case> mSound;
    QVector<Case> mWithPlanes;
    QVector<Case> mAll;
    std::mt19937 mRandom;
};

} // namespace lampblack::protocol
