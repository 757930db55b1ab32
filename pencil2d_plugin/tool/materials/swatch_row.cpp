#include "tool/materials/swatch_row.h"

#include "tool/panel/ignore_wheel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>

#include <array>

namespace lampblack
{

namespace
{
constexpr int SwatchSide = 22;
constexpr int ArrowSide = 16;
constexpr double MaxVolume = 4;
constexpr double MaxEmission = 20;
constexpr double Near = 0.3; ///< share of the figure; more tears it apart
} // namespace

SwatchRow::SwatchRow(const QString& colour, int columnWidth, QWidget* parent)
    : QWidget(parent), mColour(colour), mSwatch(new QWidget(this)), mArrow(new QToolButton(this)),
      mDiffuse(new QCheckBox(this)), mGlossy(new QCheckBox(this))
{
    setObjectName(QStringLiteral("lampblack.materials.row.") + colour);
    mSwatch->setFixedSize(SwatchSide, SwatchSide);
    mArrow->setObjectName(QStringLiteral("lampblack.materials.more.") + colour);
    mArrow->setToolTip(tr("Look and volume of this colour"));
    mArrow->setAccessibleName(tr("More about %1").arg(colour));
    mArrow->setArrowType(Qt::RightArrow);
    mArrow->setAutoRaise(true);
    mArrow->setFixedSize(ArrowSide, SwatchSide);
    mArrow->setFocusPolicy(Qt::TabFocus);
    connect(mArrow, &QToolButton::clicked, this, [this] { setOpen(mArrow->arrowType() == Qt::RightArrow); });
    auto* name = new QLabel(colour, this);
    mDiffuse->setObjectName(QStringLiteral("lampblack.materials.diffuse.") + colour);
    mDiffuse->setAccessibleName(tr("%1 diffuse").arg(colour));
    mDiffuse->setToolTip(tr("Diffuse: matt, takes light and shade"));
    mGlossy->setObjectName(QStringLiteral("lampblack.materials.glossy.") + colour);
    mGlossy->setAccessibleName(tr("%1 glossy").arg(colour));
    mGlossy->setToolTip(tr("Glossy: shows highlights"));
    name->setMinimumWidth(name->fontMetrics().horizontalAdvance(colour.left(4)));
    auto* row = new QHBoxLayout;
    row->setSpacing(6);
    row->addWidget(mArrow);
    row->addWidget(mSwatch);
    row->addWidget(name, 1);
    for (QCheckBox* box : {mDiffuse, mGlossy})
    {
        auto* cell = new QWidget(this);
        cell->setFixedWidth(columnWidth);
        auto* centred = new QHBoxLayout(cell);
        centred->setContentsMargins(0, 0, 0, 0);
        centred->addWidget(box, 0, Qt::AlignCenter);
        row->addWidget(cell);
    }
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(1, 2, 2, 2);
    column->setSpacing(3);
    column->addLayout(row);
    const auto tick = [this](bool Material::*field, bool on)
    {
        Material material = mMaterial;
        material.*field = on;
        Q_EMIT edited(mColour, material, 0);
    };
    connect(mDiffuse, &QCheckBox::clicked, this, [tick](bool on) { tick(&Material::diffuse, on); });
    connect(mGlossy, &QCheckBox::clicked, this, [tick](bool on) { tick(&Material::glossy, on); });
    setMaterial(Material());
}

void SwatchRow::setMaterial(const Material& material)
{
    mMaterial = material;
    mDiffuse->setChecked(material.diffuse);
    mGlossy->setChecked(material.glossy);
    if (mLook != nullptr)
    {
        mLook->setCurrentIndex(int(material.look));
        mEmission->setValue(material.emission);
    }
    if (material.glossy && mGloss == nullptr)
        buildGloss();
    if (mGloss == nullptr)
        return;
    mGloss->setVisible(material.glossy);
    mRoughness->setVisible(material.glossy);
    mGloss->setValue(material.gloss);
    mRoughness->setValue(material.roughness);
}

void SwatchRow::buildGloss()
{
    mGloss = new ValueRow(QStringLiteral("lampblack.materials.gloss.") + mColour, tr("Gloss"),
                          {0, 1, 1, 0, false, 2}, this);
    addValue(mGloss, tr("How strong the highlights are"));
    mRoughness = new ValueRow(QStringLiteral("lampblack.materials.roughness.") + mColour, tr("Roughness"),
                              {0.02, 1, 1, 0, false, 2}, this);
    addValue(mRoughness, tr("How wide the highlights are: 0.02 is a mirror, 1 is satin"));
    const auto change = [this](double Material::*field, double value, int gesture)
    {
        Material material = mMaterial;
        material.*field = value;
        Q_EMIT edited(mColour, material, gesture);
    };
    connect(mGloss, &ValueRow::edited, this,
            [change](double value, int gesture) { change(&Material::gloss, value, gesture); });
    connect(mRoughness, &ValueRow::edited, this,
            [change](double value, int gesture) { change(&Material::roughness, value, gesture); });
}

void SwatchRow::addValue(ValueRow* value, const QString& hint)
{
    value->setHint(hint);
    value->layout()->setContentsMargins(ArrowSide + SwatchSide + 6, 0, 4, 0);
    layout()->addWidget(value);
}

void SwatchRow::buildMore()
{
    mLookRow = new QWidget(this);
    mLook = new QComboBox(mLookRow);
    mLook->setObjectName(QStringLiteral("lampblack.materials.look.") + mColour);
    mLook->setAccessibleName(tr("Look of %1").arg(mColour));
    mLook->setToolTip(
        tr("Smooth: soft light on this colour. Cel: flat tones on this colour, whatever the scene has"));
    mLook->addItems({tr("as the scene"), tr("smooth"), tr("cel")});
    ignoreWheelWithoutFocus(mLook);
    auto* row = new QHBoxLayout(mLookRow);
    row->setContentsMargins(ArrowSide + SwatchSide + 6, 0, 4, 0);
    row->addWidget(new QLabel(tr("Look"), mLookRow));
    row->addStretch(1);
    row->addWidget(mLook);
    layout()->addWidget(mLookRow);
    mEmission = new ValueRow(QStringLiteral("lampblack.materials.emission.") + mColour, tr("Shines"),
                             {0, MaxEmission, 5, 2, false, 2}, this);
    addValue(mEmission, tr("This colour gives light to what is around it: a flame, a lamp, a screen"));
    mVolume = new ValueRow(QStringLiteral("lampblack.materials.volume.") + mColour, tr("Volume"),
                           {0, MaxVolume, 2, 0, false, 2}, this);
    addValue(mVolume, tr("Below 1 this colour is flatter, above 1 it is rounder"));
    mNearer = new ValueRow(QStringLiteral("lampblack.materials.nearer.") + mColour, tr("Nearer"),
                           {-1, 1, Near, 0, true, 2}, this);
    addValue(
        mNearer,
        tr("Above 0 this colour comes towards you, below 0 it goes back. What is in front throws a shadow"));
    connect(mLook, qOverload<int>(&QComboBox::activated), this,
            [this](int look)
            {
                Material material = mMaterial;
                material.look = static_cast<LookChoice>(look);
                Q_EMIT edited(mColour, material, 0);
            });
    connect(mEmission, &ValueRow::edited, this,
            [this](double value, int gesture)
            {
                Material material = mMaterial;
                material.emission = value;
                Q_EMIT edited(mColour, material, gesture);
            });
    const auto correct = [this](double DepthColour::*field, double value, int gesture)
    {
        DepthColour correction = mCorrection;
        correction.*field = value;
        Q_EMIT corrected(correction, gesture);
    };
    connect(mVolume, &ValueRow::edited, this,
            [correct](double value, int gesture) { correct(&DepthColour::volume, value, gesture); });
    connect(mNearer, &ValueRow::edited, this,
            [correct](double value, int gesture) { correct(&DepthColour::nearer, value, gesture); });
}

void SwatchRow::setOpen(bool open)
{
    mArrow->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    if (open && mLook == nullptr)
        buildMore();
    const std::array<QWidget*, 4> details{mLookRow, mEmission, mVolume, mNearer};
    for (QWidget* widget : details)
        if (widget != nullptr)
            widget->setVisible(open);
    setMaterial(mMaterial);
    setCorrection(mCorrection);
}

void SwatchRow::setCorrection(const DepthColour& correction)
{
    mCorrection = correction;
    if (mVolume == nullptr)
        return;
    mVolume->setValue(correction.volume);
    mNearer->setValue(correction.nearer);
}

void SwatchRow::setHighlighted(bool highlighted)
{
    if (highlighted == mHighlighted)
        return;
    mHighlighted = highlighted;
    update();
}

void SwatchRow::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    if (mHighlighted)
    {
        QColor band = palette().color(QPalette::Highlight);
        painter.setPen(band);
        band.setAlpha(60);
        painter.setBrush(band);
        painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 3, 3);
    }
    painter.setPen(QColor(0, 0, 0, 110));
    painter.setBrush(QColor(mColour));
    painter.drawRoundedRect(QRectF(mSwatch->geometry()).adjusted(0.5, 0.5, -0.5, -0.5), 2, 2);
}

} // namespace lampblack
