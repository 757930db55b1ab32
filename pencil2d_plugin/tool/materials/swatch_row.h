// One flat colour and what it wears.
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
    /// The two boxes stand in the middle of columns of `columnWidth`.
    SwatchRow(const QString& colour, int columnWidth, QWidget* parent = nullptr);

    const QString& colour() const { return mColour; }
    /// Show a material; tells nobody.
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
    ValueRow* mGloss = nullptr; ///< made once the colour is glossy: a drawing may have 256 colours
    ValueRow* mRoughness = nullptr;
};

} // namespace lampblack
