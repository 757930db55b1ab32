// One flat colour and its material.
#pragma once

#include "scene/scene.h"
#include "tool/panel/value_row.h"

#include <QCheckBox>
#include <QComboBox>
#include <QToolButton>
#include <QWidget>

namespace lampblack
{

/// An arrow opens what else there is: the look, and the surface.
class SwatchRow : public QWidget
{
    Q_OBJECT

public:
    /// Each of the two check boxes is centred in a column of `columnWidth`.
    SwatchRow(const QString& colour, int columnWidth, QWidget* parent = nullptr);

    const QString& colour() const { return mColour; }
    /// Show a material; does not emit edited().
    void setMaterial(const Material& material);
    /// Show how the surface of the colour is corrected; does not emit corrected().
    void setCorrection(const DepthColour& correction);
    void setHighlighted(bool highlighted);

Q_SIGNALS:
    void edited(const QString& colour, const lampblack::Material& material, int gesture);
    void corrected(const lampblack::DepthColour& correction, int gesture);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void buildGloss();
    void buildMore();
    void setOpen(bool open);
    void addValue(ValueRow* value, const QString& hint);

    QString mColour;
    Material mMaterial;
    DepthColour mCorrection;
    bool mHighlighted = false;
    QWidget* mSwatch;
    QToolButton* mArrow;
    QCheckBox* mDiffuse;
    QCheckBox* mGlossy;
    ValueRow* mGloss = nullptr; ///< created when needed, because a drawing may have 256 colours
    ValueRow* mRoughness = nullptr;
    QWidget* mLookRow = nullptr; ///< created when the row is opened, as are the next four
    QComboBox* mLook = nullptr;
    ValueRow* mEmission = nullptr;
    ValueRow* mVolume = nullptr;
    ValueRow* mNearer = nullptr;
};

} // namespace lampblack
