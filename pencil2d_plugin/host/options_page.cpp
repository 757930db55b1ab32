#include "host/options_page.h"

#include <QGridLayout>
#include <QScrollArea>
#include <QTimer>

namespace lampblack
{

OptionsPage::~OptionsPage()
{
    show(false);
    delete mPage;
}

void OptionsPage::setPanel(QWidget* panel)
{
    if (mPage != nullptr || mParts.options == nullptr || mParts.options->widget() == nullptr)
        return;
    auto* scroll = qobject_cast<QScrollArea*>(panel);
    if (scroll == nullptr)
    {
        scroll = new QScrollArea;
        scroll->setFrameShape(QFrame::NoFrame);
        scroll->setWidgetResizable(true);
        scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        scroll->setWidget(panel);
    }
    mPage = scroll;
    mPage->hide();
    QLayout* layout = mParts.options->widget()->layout();
    if (auto* grid = qobject_cast<QGridLayout*>(layout))
        grid->addWidget(mPage, 0, 0);
    else
        layout->addWidget(mPage);
    mPage->setVisible(mShown);
}

/// The canvas beside it would jump: in Pencil2D 0.7 the docks are wider at first than their contents need.
void OptionsPage::holdWidth()
{
    if (mHolding || mParts.options->isFloating() || mParts.options->isHidden() || mParts.window == nullptr)
        return;
    mHolding = true;
    const int least = mParts.options->minimumWidth();
    const int width = mParts.options->width();
    mParts.options->setMinimumWidth(width);
    const auto release = [this, least, width]
    {
        mHolding = false;
        if (mParts.window == nullptr || mParts.options == nullptr)
            return;
        mParts.window->resizeDocks({mParts.options}, {width}, Qt::Horizontal);
        mParts.options->setMinimumWidth(least);
    };
    // Later than the layout of all docks, which goes on for some events.
    constexpr int LayoutMs = 100;
    QTimer::singleShot(LayoutMs, this, release);
}

void OptionsPage::show(bool panel)
{
    mShown = panel;
    if (mPage == nullptr || mParts.options == nullptr)
        return;
    holdWidth();
    QWidget* place = mParts.options->widget();
    if (panel)
    {
        const auto others = place->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly);
        for (QWidget* other : others)
        {
            if (other == mPage || other->isHidden())
                continue;
            other->hide();
            mHidden.append(other);
        }
        mPage->show();
        return;
    }
    mPage->hide();
    for (const auto& other : qAsConst(mHidden))
    {
        if (other != nullptr)
            other->show();
    }
    mHidden.clear();
}

} // namespace lampblack
