// One flat colour and its material.
#pragma once

#include "scene/scene.h"
#include "tool/panel/value_row.h"

#include <QCheckBox>
#include <QWidget>

namespace lampblack
{

class SwatchRow : public QWidget
{
    Q_OBJECT

public:
    /// Each of the two check boxes is centred in a column of `columnWidth`.
    SwatchRow(const QString& colour, int columnWidth, QWidget* parent = nullptr);

    const QString& colour() const { return mColour; }
    /// Show a material; does not emit edited().
    void setMaterial(const Material& material);
    void setHighlighted(bool highlighted);

Q_SIGNALS:
    void edited(const QString& colour, const lampblack::Material& material, int gesture);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void buildGloss();

    QString mColour;
    Material mMaterial;
    bool mHighlighted = false;
    QWidget* mSwatch;
    QCheckBox* mDiffuse;
    QCheckBox* mGlossy;
    ValueRow* mGloss = nullptr; ///< created when needed, because a drawing may have 256 colours
    ValueRow* mRoughness = nullptr;
};

} // namespace lampblack
